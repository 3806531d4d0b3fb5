// Registers flaprig.quasi_steady and flaprig.uvlm with MuJoCo.
//
// No exception may leave a callback, and mju_error jumps past destructors: every refusal is first
// copied to plain memory, then everything is destroyed, then the error is raised.

#include <mujoco/mujoco.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <tuple>

#include "../clock.hpp"
#include "registry.hpp"

namespace flaprig {
namespace {

constexpr int kMessage = 900;

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
    std::snprintf(message, kMessage, "%s: %s", title_of(m, id, model).c_str(), e.what());
    return false;
  }
}

// here nothing is allocated yet, so whatever can be refused is refused here
template <Model model>
int nstate(const mjModel* m, int id) {
  char message[kMessage];
  int size = 0;
  const bool good = guarded(m, id, model, message, [&] {
    require_options(m);
    const Specification s = read_specification(model, attributes_of(m, id, model));
    const Place place = place_of(m, id, s.plate);
    for (const std::string& doubt : doubts(m, place, s.planform, s.wind_w)) tell(m, id, model, doubt);
    size = Memory::kSize + state_size(s);
  });
  if (!good) mju_error("%s", message);
  return size;
}

// 9 for every sensor: at the first call MuJoCo does not know yet what the sensor is attached to
int nsensordata(const mjModel*, int, int) { return 9; }

bool make_instance(const mjModel* m, const mjData* d, int id, Model model, char* message) {
  return guarded(m, id, model, message, [&] {
    registry().put(d, id, std::make_unique<Instance>(m, id, model));
  });
}

// an mjData that was unpickled has not been through init
template <Model model>
Instance* instance_of(const mjModel* m, const mjData* d, int id) {
  if (Instance* found = registry().find(d, id)) return found;
  char message[kMessage];
  if (!make_instance(m, d, id, model, message)) mju_error("%s", message);
  return registry().find(d, id);
}

template <Model model>
int init(const mjModel* m, mjData* d, int id) {
  if (mj_version() != mjVERSION_HEADER) {
    mju_warning("flaprig was compiled for another MuJoCo: %d, not %d", mjVERSION_HEADER,
                mj_version());
    return -1;
  }
  char message[kMessage];
  d->plugin_data[id] = 0;
  if (make_instance(m, d, id, model, message)) return 0;
  // what MuJoCo frees after a -1, whose message would not tell the reason
  for (int other = 0; other < id; ++other) registry().remove(d, other);
  mju_free(d->buffer), mju_free(d->arena), mju_free(d);
  mju_error("%s", message);
  return -1;
}

void destroy(mjData* d, int id) { registry().remove(d, id); }

// between mj_step1 and mj_step2 an instance knows what the state does not
template <Model model>
void copy(mjData* to, const mjModel* m, const mjData* from, int id) {
  instance_of<model>(m, to, id)->copy_stage(*instance_of<model>(m, from, id));
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

// noslip works with J inv(M) J^T, which MuJoCo made before the added mass was in M. It is made once
// more, by the family's last instance, on top of the arena, and put into the place of the first.
void rebuild_projection(const mjModel* m, mjData* d, int id) {
  for (int other = id + 1; other < m->nplugin; ++other) {
    if (in_family(m, other)) return;
  }
  if (!mj_isDual(m) || d->nefc == 0) return;
  const int constraints = d->nefc;
  auto fields =
      std::tie(d->parena, d->efc_Y, d->efc_Y_rownnz, d->efc_Y_rowadr, d->efc_Y_colind, d->efc_AR,
               d->efc_AR_rownnz, d->efc_AR_rowadr, d->efc_AR_colind);
  const auto before = std::apply([](auto... values) { return std::make_tuple(values...); }, fields);
  mj_projectConstraint(m, d);
  // no room: MuJoCo has dropped all constraints and counted a warning
  if (d->nefc != constraints) return;
  mju_copy(std::get<1>(before), d->efc_Y, d->nY);
  mju_copy(std::get<5>(before), d->efc_AR, d->nA);
  fields = before;
}

template <Model model>
void compute(const mjModel* m, mjData* d, int id, int capability) {
  Stopwatch clock(Phase::kPlugin);
  Instance* instance = instance_of<model>(m, d, id);
  if (capability == mjPLUGIN_SENSOR) {
    instance->sense(m, d, memory_of(m, d, id), true);
  } else {
    instance->receive(m, d, memory_of(m, d, id));
    rebuild_mass(m, d, id);
    instance->compute(m, d);
    rebuild_projection(m, d, id);
  }
}

template <Model model>
void advance(const mjModel* m, mjData* d, int id) {
  Stopwatch clock(Phase::kPlugin);
  Instance* instance = instance_of<model>(m, d, id);
  char message[kMessage];
  const bool good = guarded(m, id, model, message, [&] {
    require_options(m);
    instance->tell_doubts(m);
    instance->receive(m, d, memory_of(m, d, id));
    instance->advance(m, d, memory_of(m, d, id));
  });
  if (!good) mju_error("%s", message);
}

template <Model model>
void visualize(const mjModel* m, mjData* d, const mjvOption*, mjvScene* scene, int id) {
  instance_of<model>(m, d, id)->draw(m, d, scene, memory_of(m, d, id));
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
  plugin.copy = copy<model>;
  plugin.compute = compute<model>;
  plugin.advance = advance<model>;
  plugin.visualize = visualize<model>;
  mjp_registerPlugin(&plugin);
}

// Of MuJoCo's word on a plugin that it does not know, its name is the one thing that a model file can
// choose: a file that names this one first is told by it what is missing. It does nothing.
void add_hint() {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = "flaprig (first call flaprig.load_plugins())";
  plugin.capabilityflags = mjPLUGIN_PASSIVE;
  plugin.nstate = [](const mjModel*, int) { return 0; };
  plugin.compute = [](const mjModel*, mjData*, int, int) {};
  mjp_registerPlugin(&plugin);
}

mjPLUGIN_LIB_INIT(flaprig) {
  add_hint();
  add<Model::kQuasiSteady>();
  add<Model::kUvlm>();
}

}  // namespace
}  // namespace flaprig
