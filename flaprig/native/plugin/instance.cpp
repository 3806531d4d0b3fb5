#include "instance.hpp"

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
  if (m->opt.noslip_iterations > 0) {
    throw std::invalid_argument(
        "noslip_iterations run a solver that does not know the added mass in M; leave them at 0");
  }
  if ((m->opt.disableflags & mjDSBL_SPRING) && (m->opt.disableflags & mjDSBL_DAMPER)) {
    throw std::invalid_argument(
        "disabling both spring and damper removes every passive force, the air's too; leave one "
        "of them enabled");
  }
}

namespace {

int body_of(const mjModel* m, int instance) {
  int body = -1;
  for (int b = 0; b < m->nbody; ++b) {
    if (m->body_plugin[b] != instance) continue;
    if (body >= 0) {
      throw std::invalid_argument("the instance is attached to two bodies; give each wing its own");
    }
    body = b;
  }
  if (body < 0) throw std::invalid_argument("the instance is attached to no body");
  return body;
}

}  // namespace

Place place_of(const mjModel* m, int instance, const PlateSettings& plate) {
  Place place{body_of(m, instance), -1};
  if (plate.site.empty()) {
    throw std::invalid_argument(
        "site must be given: the name of a site on the wing's body whose x axis points along the "
        "chord from leading to trailing edge, y along the span, z along the normal");
  }
  // mj_name2id is not to be used here: it needs the hash map, which is made later
  for (int s = 0; s < m->nsite; ++s) {
    if (plate.site == m->names + m->name_siteadr[s]) place.site = s;
  }
  if (place.site < 0 || m->site_bodyid[place.site] != place.body) {
    throw std::invalid_argument("site must be the name of a site on the wing's own body, got " +
                                quoted(plate.site));
  }
  return place;
}

Instance::Instance(const mjModel* m, int instance, Model model) : id_(instance), model_(model) {
  require_options(m);
  const Specification s = read_specification(model, attributes_of(m, instance, model));
  plate_ = s.plate;
  plate_weight_ = s.density * s.plate.thickness * s.planform.area();
  centroid_ = {s.planform.centroid_x(), s.planform.centroid_y(), 0};
  const Place place = place_of(m, instance, plate_);
  body_ = place.body, site_ = place.site;
  check_dofs(m);
  air_ = make_air(s);
  jacobian_.resize(6 * m->nv), scratch_.resize(6 * m->nv);
}

void Instance::receive(const mjModel* m, mjData* d, Memory memory) const {
  const std::string fault = make_sound(*air_, memory.air(), m->opt.timestep);
  if (fault.empty()) return;
  mjWarningStat& count = d->warning[mjWARN_BADQPOS];
  count.lastinfo = id_;
  if (count.number++ > 0) return;
  const char* name = m->names + m->name_pluginadr[id_];
  mju_warning("%s \"%s\": plugin_state is none that a run leaves behind (%s); the wake is cleared "
              "at time %g",
              kModelNames[static_cast<int>(model_)], name, fault.c_str(), d->time);
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
