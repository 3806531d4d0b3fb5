// Registers flaprig.quasi_steady and flaprig.uvlm with MuJoCo.
//
// No exception may leave a callback, and mju_error jumps past destructors: every refusal is first
// copied to plain memory, then everything is destroyed, then the error is raised.

#include <mujoco/mujoco.h>

#include <cstdio>
#include <exception>
#include <string>

#include "instance.hpp"

namespace flaprig {
namespace {

constexpr int kMessage = 900;

Instance* instance_of(mjData* d, int id) { return reinterpret_cast<Instance*>(d->plugin_data[id]); }

Memory memory_of(const mjModel* m, mjData* d, int id) {
  return {d->plugin_state + m->plugin_stateadr[id]};
}

bool in_family(const mjModel* m, int id) {
  const mjpPlugin* plugin = mjp_getPluginAtSlot(m->plugin[id]);
  for (const char* name : kModelNames) {
    if (plugin && std::string_view(plugin->name) == name) return true;
  }
  return false;
}

// runs the work; true when it went well, else the message holds why not
template <class Work>
bool guarded(const mjModel* m, int id, Model model, char* message, Work work) {
  try {
    work();
    return true;
  } catch (const std::exception& e) {
    const char* name = m->names + m->name_pluginadr[id];
    std::snprintf(message, kMessage, "%s%s%s%s: %s", kModelNames[static_cast<int>(model)],
                  *name ? " \"" : "", name, *name ? "\"" : "", e.what());
    return false;
  }
}

template <Model model>
int nstate(const mjModel* m, int id) {
  char message[kMessage];
  int size = 0;
  const bool good = guarded(m, id, model, message, [&] {
    size = Memory::kSize + state_size(read_specification(model, attributes_of(m, id, model)));
  });
  if (!good) mju_error("%s", message);
  return size;
}

// 9 for every sensor: at the first call MuJoCo does not know yet what the sensor is attached to
int nsensordata(const mjModel*, int, int) { return 9; }

template <Model model>
int init(const mjModel* m, mjData* d, int id) {
  if (mj_version() != mjVERSION_HEADER) {
    mju_warning("flaprig was compiled for another MuJoCo: %d, not %d", mjVERSION_HEADER,
                mj_version());
    return -1;
  }
  char message[kMessage];
  const bool good = guarded(m, id, model, message, [&] {
    d->plugin_data[id] = reinterpret_cast<uintptr_t>(new Instance(m, id, model));
  });
  if (good) return 0;
  d->plugin_data[id] = 0;
  mju_error("%s", message);
  return -1;
}

void destroy(mjData* d, int id) {
  delete instance_of(d, id);
  d->plugin_data[id] = 0;
}

void reset(const mjModel* m, mjtNum* state, void*, int id) {
  mju_zero(state, m->plugin_statenum[id]);
}

// M is rebuilt once, by the family's first instance, so that evaluating the velocity stage again
// without the position stage does not add the mass twice
void rebuild_mass(const mjModel* m, mjData* d, int id) {
  for (int other = 0; other < id; ++other) {
    if (in_family(m, other)) return;
  }
  mj_makeM(m, d);
}

void compute(const mjModel* m, mjData* d, int id, int capability) {
  Instance* instance = instance_of(d, id);
  if (capability == mjPLUGIN_SENSOR) {
    instance->sense(m, d, memory_of(m, d, id));
  } else {
    rebuild_mass(m, d, id);
    instance->compute(m, d);
  }
}

template <Model model>
void advance(const mjModel* m, mjData* d, int id) {
  const char* refusal = refused_option(m);
  if (refusal) mju_error("%s: %s", kModelNames[static_cast<int>(model)], refusal);
  char message[kMessage];
  const bool good = guarded(m, id, model, message,
                            [&] { instance_of(d, id)->advance(m, d, memory_of(m, d, id)); });
  if (!good) mju_error("%s", message);
}

void visualize(const mjModel* m, mjData* d, const mjvOption*, mjvScene* scene, int id) {
  instance_of(d, id)->draw(m, d, scene, memory_of(m, d, id));
}

template <Model model>
void add() {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = kModelNames[static_cast<int>(model)];
  plugin.nattribute = static_cast<int>(attribute_names(model).size());
  plugin.attributes = attribute_names(model).data();
  plugin.capabilityflags = mjPLUGIN_PASSIVE | mjPLUGIN_SENSOR;
  plugin.needstage = mjSTAGE_VEL;
  plugin.nstate = nstate<model>;
  plugin.nsensordata = nsensordata;
  plugin.init = init<model>;
  plugin.destroy = destroy;
  plugin.reset = reset;
  plugin.compute = compute;
  plugin.advance = advance<model>;
  plugin.visualize = visualize;
  mjp_registerPlugin(&plugin);
}

mjPLUGIN_LIB_INIT(flaprig) {
  add<Model::kQuasiSteady>();
  add<Model::kUvlm>();
}

}  // namespace
}  // namespace flaprig
