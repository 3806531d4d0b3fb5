#include "instance.hpp"

#include <cstdio>
#include <stdexcept>
#include <string>

#include "../reader.hpp"

namespace flaprig {

Vec3 vec3(const mjtNum* p) { return {p[0], p[1], p[2]}; }

Attributes attributes_of(const mjModel* m, int instance, Model model) {
  Attributes attributes;
  for (const char* name : attribute_names(model)) {
    const char* value = mj_getPluginConfig(m, instance, name);
    if (value && *value) attributes[name] = value;
  }
  return attributes;
}

std::string title_of(const mjModel* m, int instance, Model model) {
  const char* name = m->names + m->name_pluginadr[instance];
  return kModelNames[static_cast<int>(model)] + (*name ? " " + quoted(name) : std::string());
}

void require_options(const mjModel* m) {
  if (m->opt.integrator == mjINT_RK4) {
    throw std::invalid_argument(
        "integrator RK4 evaluates the air at poses that the wake never sees; use implicitfast, "
        "implicit or Euler");
  }
  if (m->opt.solver == mjSOL_PGS) {
    throw std::invalid_argument(
        "solver PGS does not know the added mass in M; use Newton or CG");
  }
  if ((m->opt.disableflags & mjDSBL_SPRING) && (m->opt.disableflags & mjDSBL_DAMPER)) {
    throw std::invalid_argument(
        "disabling both spring and damper removes every passive force, the air's too; leave one "
        "of them enabled");
  }
}

namespace {

// of MuJoCo's own fluid
std::array<double, 5> scene_options(const mjModel* m) {
  return {m->opt.density, m->opt.viscosity, m->opt.wind[0], m->opt.wind[1], m->opt.wind[2]};
}

}  // namespace

Instance::Instance(const mjModel* m, int instance, Model model) : id_(instance), model_(model) {
  require_options(m);
  const Specification s = read_specification(model, attributes_of(m, instance, model));
  plate_ = s.plate;
  plate_weight_ = s.density * s.plate.thickness * s.planform.area();
  centroid_ = {s.planform.centroid_x(), s.planform.centroid_y(), 0};
  const Place place = place_of(m, instance, plate_);
  body_ = place.body, site_ = place.site;
  options_ = scene_options(m);
  check_dofs(m);
  air_ = make_air(s);
  jacobian_.resize(6 * m->nv), scratch_.resize(6 * m->nv);
}

void tell(const mjModel* m, int instance, Model model, const std::string& text) {
  mju_warning("%s", (title_of(m, instance, model) + ": " + text).c_str());
}

void Instance::tell_doubts(const mjModel* m) {
  const auto options = scene_options(m);
  if (options == options_) return;
  options_ = options;
  const Specification s = read_specification(model_, attributes_of(m, id_, model_));
  for (const std::string& doubt : doubts(m, {body_, site_, {}}, s.planform, s.wind_w)) {
    tell(m, id_, model_, doubt);
  }
}

void Instance::receive(const mjModel* m, mjData* d, Memory memory) const {
  const std::string fault = make_sound(*air_, memory.air(), m->opt.timestep);
  if (fault.empty()) return;
  mjWarningStat& count = d->warning[mjWARN_BADQACC];
  count.lastinfo = id_;
  if (count.number++ > 0) return;
  char time[40];
  std::snprintf(time, sizeof time, "%g", d->time);
  tell(m, id_, model_, "plugin_state is none that a run leaves behind (" + fault +
                           "); the wake is cleared at time " + time);
}

// MuJoCo leaves out the off-diagonal inertia of bodies that it calls simple
void Instance::check_dofs(const mjModel* m) const {
  auto& dofs = const_cast<std::vector<int>&>(dofs_);
  int body = body_;
  while (body > 0 && m->body_dofnum[body] == 0) body = m->body_parentid[body];
  if (body == 0) return;  // welded to the world: loads are reported, nothing moves
  for (int i = m->body_dofadr[body] + m->body_dofnum[body] - 1; i >= 0; i = m->dof_parentid[i]) {
    dofs.insert(dofs.begin(), i);
  }
  for (int i = 0; i < static_cast<int>(dofs.size()); ++i) {
    if (m->M_rownnz[dofs[i]] <= i) {
      throw std::invalid_argument(
          "MuJoCo keeps no off-diagonal inertia for a free body whose centre of mass is its own "
          "origin; shift the body's <inertial> by 1e-6 m to make room for the added mass");
    }
  }
}

}  // namespace flaprig
