// The air in MuJoCo's dynamics: mass into M, the rest into the passive forces.
//
// The load is F = f(q, v, wake) - A xi_dot, xi = J v the wing's twist in its own axes. With
// xi_dot = J qacc + Jdot v, the term J^T A J joins M and J^T (f - A Jdot v) is a passive force.

#include "instance.hpp"

namespace flaprig {

void Instance::find_jacobian(const mjModel* m, const mjData* d) {
  const int nv = m->nv;
  motion_.position_w = vec3(d->site_xpos + 3 * site_);
  std::copy_n(d->site_xmat + 9 * site_, 9, motion_.rotation.m.begin());
  const Mat3& r = motion_.rotation;
  const auto to_wing = [&](std::vector<mjtNum>& j) {
    for (int block = 0; block < 2; ++block) {
      mjtNum* p = j.data() + 3 * nv * block;
      for (int i : dofs_) {
        const Vec3 w = transposed(r, {p[i], p[nv + i], p[2 * nv + i]});
        p[i] = w.x, p[nv + i] = w.y, p[2 * nv + i] = w.z;
      }
    }
  };
  mj_jacSite(m, d, jacobian_.data(), jacobian_.data() + 3 * nv, site_);
  mj_jacDot(m, d, scratch_.data(), scratch_.data() + 3 * nv, d->site_xpos + 3 * site_, body_);
  to_wing(jacobian_), to_wing(scratch_);
}

// J, the motion, and its rate at zero acceleration
void Instance::read_motion(const mjModel* m, const mjData* d) {
  find_jacobian(m, d);
  motion_.twist = through_jacobian(d->qvel);
  jacobian_.swap(scratch_);
  motion_.twist_rate = through_jacobian(d->qvel);
  jacobian_.swap(scratch_);
  // components of a turning frame: d(R^T v)/dt = R^T dv/dt - w x R^T v
  const Twist& t = motion_.twist;
  motion_.twist_rate.linear = motion_.twist_rate.linear - cross(t.angular, t.linear);
}

Twist Instance::through_jacobian(const mjtNum* velocity) const {
  const int nv = static_cast<int>(jacobian_.size() / 6);
  double out[6] = {};
  for (int row = 0; row < 6; ++row) {
    for (int i : dofs_) out[row] += jacobian_[row * nv + i] * velocity[i];
  }
  return {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
}

void Instance::add_mass(const mjModel* m, mjData* d) const {
  const int nv = m->nv;
  const mjtNum* rows[3] = {&jacobian_[2 * nv], &jacobian_[3 * nv], &jacobian_[4 * nv]};
  const AddedMass& a = air_->added_mass();
  for (int i : dofs_) {
    double ja[3];  // row i of J^T A
    for (int c = 0; c < 3; ++c) {
      ja[c] = rows[0][i] * a[c] + rows[1][i] * a[3 + c] + rows[2][i] * a[6 + c];
    }
    const int start = m->M_rowadr[i];
    for (int k = 0; k < m->M_rownnz[i]; ++k) {
      const int j = m->M_colind[start + k];
      d->M[start + k] += ja[0] * rows[0][j] + ja[1] * rows[1][j] + ja[2] * rows[2][j];
    }
  }
  mj_factorM(m, d);
}

Wrench Instance::buoyancy(const mjModel* m) const {
  if (!plate_.buoyancy || (m->opt.disableflags & mjDSBL_GRAVITY)) return {};
  const Vec3 gravity = transposed(motion_.rotation, vec3(m->opt.gravity));
  const Vec3 force = -plate_weight_ * gravity;
  return {force, cross(centroid_, force)};
}

// all of the fluid's dynamic load but the added mass on the joints' acceleration; buoyancy, which
// acts on a wing at rest too, is kept apart: lift, drag and power are those of the motion
void Instance::find_load(const mjModel* m, const mjData* d) {
  const double* state = Memory{d->plugin_state + m->plugin_stateadr[id_]}.air();
  if (air_->prepares()) {
    // only advance() may change the state: until then the wake of this instant lives here
    ahead_.assign(state, state + air_->state_size());
    air_->prepare(ahead_.data(), motion_, m->opt.timestep);
    state = ahead_.data();
  }
  const Loads loads = air_->loads(state, motion_);
  const Motion relative = relative_to_wind(motion_, air_->wind_w());
  velocity_load_ = loads.base + loads.extra +
                   added_mass_wrench(air_->added_mass(), relative.twist_rate);
  computed_ = true;
}

void Instance::compute(const mjModel* m, mjData* d) {
  read_motion(m, d);
  find_load(m, d);
  // MuJoCo leaves M of a sleeping tree as it is, and so must we
  const int tree = m->body_treeid[body_];
  if (tree < 0 || !d->tree_awake[tree]) return;
  add_mass(m, d);
  const Wrench load = velocity_load_ + buoyancy(m);
  const Vec3 force = motion_.rotation * load.force, torque = motion_.rotation * load.torque;
  const mjtNum f[3] = {force.x, force.y, force.z}, t[3] = {torque.x, torque.y, torque.z};
  mj_applyFT(m, d, f, t, d->site_xpos + 3 * site_, body_, d->qfrc_passive);
}

void Instance::copy_stage(const Instance& other) {
  computed_ = other.computed_;
  motion_ = other.motion_;
  velocity_load_ = other.velocity_load_;
  ahead_ = other.ahead_;
  jacobian_ = other.jacobian_;
}

// mjData was pickled in the middle of a step: its velocities still are those of the beginning,
// qvel is not
void Instance::recover(const mjModel* m, const mjData* d) {
  read_motion(m, d);
  mjtNum twist[6];  // angular first
  mj_objectVelocity(m, d, mjOBJ_SITE, site_, twist, 1);
  motion_.twist = {vec3(twist + 3), vec3(twist)};
  find_load(m, d);
}

// Here qpos, qvel and time are the new ones, everything else is still of the step's beginning.
// The acceleration of the step is (v_new - v_old)/dt under every integrator; d->qacc is not.
void Instance::advance(const mjModel* m, mjData* d, Memory memory) {
  if (!computed_) recover(m, d);
  computed_ = false;
  const double dt = m->opt.timestep;
  const Twist after = through_jacobian(d->qvel), &before = motion_.twist;
  const Twist joint_rate = {(1 / dt) * (after.linear - before.linear),
                            (1 / dt) * (after.angular - before.angular)};
  const Wrench air = velocity_load_ + added_mass_wrench(air_->added_mass(), joint_rate);
  const Twist mean = {0.5 * (after.linear + before.linear), 0.5 * (after.angular + before.angular)};
  log(m, air, mean, memory);
  const Twist rate = {joint_rate.linear + motion_.twist_rate.linear,
                      joint_rate.angular + motion_.twist_rate.angular};
  put(on_mount(m, air + buoyancy(m), rate), memory.mount());
  if (air_->prepares()) std::copy(ahead_.begin(), ahead_.end(), memory.air());
  air_->advance(memory.air(), motion_, dt);
  if (!(m->opt.disableflags & mjDSBL_SENSOR)) sense(m, d, memory, false);
}

}  // namespace flaprig
