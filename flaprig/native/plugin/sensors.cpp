// What the step's load looks like to a user: wrench, lift, drag, power, and a load cell.

#include "instance.hpp"

namespace flaprig {

// mean: the step's mean twist, with which force times velocity sums up to energy exactly
void Instance::log(const mjModel* m, const Wrench& air, const Twist& mean, Memory memory) const {
  put(air, memory.wrench());
  const Vec3 gravity_w = vec3(m->opt.gravity);
  const double g = norm(gravity_w);
  const Vec3 up_w = g > 0 ? (-1 / g) * gravity_w : Vec3{0, 0, 1};
  const Vec3 force_w = motion_.rotation * air.force;
  memory.lift() = dot(force_w, up_w);
  // the motion of the wing at R2 through the fluid, without its spanwise and vertical parts
  const Motion relative = relative_to_wind(motion_, air_->wind_w());
  const Vec3 at = {0, air_->reference_radius(), 0};
  Vec3 way = relative.twist.linear + cross(relative.twist.angular, at);
  way.y = 0;
  Vec3 way_w = motion_.rotation * way;
  way_w += -dot(way_w, up_w) * up_w;
  const double speed = norm(way_w);
  memory.drag() = speed > 1e-12 ? -dot(force_w, way_w) / speed : 0;
  memory.power() = -dot(air.force, mean.linear) - dot(air.torque, mean.angular);
}

// air, buoyancy in it, + weight - inertia of the wing's own body
Wrench Instance::on_mount(const mjModel* m, const Wrench& air, const Twist& rate) const {
  const mjtNum* site_q = m->site_quat + 4 * site_;
  const auto to_wing = [&](const mjtNum* v) {
    mjtNum q[4], out[3];
    mju_negQuat(q, site_q);
    mju_rotVecQuat(out, v, q);
    return vec3(out);
  };
  const mjtNum* ipos = m->body_ipos + 3 * body_;
  mjtNum offset[3];
  mju_sub3(offset, ipos, m->site_pos + 3 * site_);
  const Vec3 centre = to_wing(offset);
  const Vec3 w = motion_.twist.angular, v = motion_.twist.linear, spin = rate.angular;
  const Vec3 acceleration = rate.linear + cross(w, v) + cross(spin, centre) +
                            cross(w, cross(w, centre));
  const bool heavy = !(m->opt.disableflags & mjDSBL_GRAVITY);
  const Vec3 gravity =
      heavy ? transposed(motion_.rotation, vec3(m->opt.gravity)) : Vec3{};
  const Vec3 force = m->body_mass[body_] * (gravity - acceleration);
  // inertia about the centre of mass, turned through the body's principal axes
  const auto inertia = [&](Vec3 a) {
    mjtNum in[3] = {a.x, a.y, a.z}, body[3], principal[3], q[4];
    mju_rotVecQuat(body, in, site_q);
    mju_negQuat(q, m->body_iquat + 4 * body_);
    mju_rotVecQuat(principal, body, q);
    for (int i = 0; i < 3; ++i) principal[i] *= m->body_inertia[3 * body_ + i];
    mju_rotVecQuat(body, principal, m->body_iquat + 4 * body_);
    return to_wing(body);
  };
  const Vec3 turning = inertia(spin) + cross(w, inertia(w));
  return {air.force + force, air.torque + cross(centre, force) - turning};
}

// a wrench about the wing frame's origin in another site's axes, about its origin
Wrench Instance::at_site(const mjModel* m, int site, const Wrench& w) const {
  const auto turned = [&](Vec3 a) {
    mjtNum in[3] = {a.x, a.y, a.z}, body[3], out[3], q[4];
    mju_rotVecQuat(body, in, m->site_quat + 4 * site_);
    mju_negQuat(q, m->site_quat + 4 * site);
    mju_rotVecQuat(out, body, q);
    return vec3(out);
  };
  mjtNum offset[3], local[3], q[4];
  mju_sub3(offset, m->site_pos + 3 * site, m->site_pos + 3 * site_);
  mju_negQuat(q, m->site_quat + 4 * site_);
  mju_rotVecQuat(local, offset, q);
  return {turned(w.force), turned(w.torque - cross(vec3(local), w.force))};
}

// all: also the sensors that MuJoCo clips or delays, which it does only after asking itself
void Instance::sense(const mjModel* m, mjData* d, Memory memory, bool all) const {
  for (int i = 0; i < m->nsensor; ++i) {
    if (m->sensor_type[i] != mjSENS_PLUGIN || m->sensor_plugin[i] != id_) continue;
    if (!all && (m->sensor_cutoff[i] > 0 || m->sensor_history[2 * i] > 0)) continue;
    mjtNum* out = d->sensordata + m->sensor_adr[i];
    if (m->sensor_objtype[i] == mjOBJ_SITE) {
      put(at_site(m, m->sensor_objid[i], get(memory.mount())), out);
      std::fill_n(out + 6, 3, 0.0);
    } else {
      std::copy_n(memory.wrench(), 6, out);
      out[6] = memory.lift(), out[7] = memory.drag(), out[8] = memory.power();
    }
  }
}

}  // namespace flaprig
