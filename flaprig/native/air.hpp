// What an air model offers to both drivers: loads at an instant, and a step of its own memory.
//
// Every vector is in wing axes (x chord aft, y span, z normal) about the wing frame's origin,
// unless its name ends in _w (world). Units are SI.
#pragma once

#include <array>
#include <string>

#include "vec3.hpp"

namespace flaprig {

struct Twist {
  Vec3 linear;   // of the frame's origin [m/s]
  Vec3 angular;  // [rad/s]
};

// the motion of the wing frame at one instant
struct Motion {
  Vec3 position_w;    // of the origin [m]
  Mat3 rotation;      // wing to world
  Twist twist;        // wing components
  Twist twist_rate;   // time derivative of those components, not of the vectors
};

struct Wrench {
  Vec3 force;   // [N]
  Vec3 torque;  // about the origin [N m]
};

inline Wrench operator+(Wrench a, Wrench b) { return {a.force + b.force, a.torque + b.torque}; }

// the load without added mass: the vortex lattice's potential part and its suction, or
// the quasi-steady model's translation and rotation
struct Loads {
  Wrench base;
  Wrench extra;
};

// row-major, acts on (v_z, w_x, w_y) and gives (F_z, M_x, M_y)
using AddedMass = std::array<double, 9>;

class Air {
 public:
  virtual ~Air() = default;
  // doubles of memory (the wake) that the model needs; may be zero
  virtual int state_size() const = 0;
  // What no run of this model can have left in the state: a clause that names the number, its value
  // and what is allowed. Empty for a sound state: only such a one may be given to the functions
  // below, which take counts and places from it. dt: of the step that begins with it, 0 for none.
  virtual std::string fault(const double*, double) const { return {}; }
  // loads at this motion; reads the state, changes nothing
  virtual Loads loads(const double* state, const Motion& motion) const = 0;
  // brings the memory up to this instant, where a step dt begins, for models whose loads look at
  // the wake of the instant itself; the others do all in advance()
  virtual void prepare(double*, const Motion&, double) const {}
  virtual bool prepares() const { return false; }
  // takes the memory over a step dt that began at this motion
  virtual void advance(double* state, const Motion& motion, double dt) const = 0;
  // symmetric 3 x 3 mass on (v_z, w_x, w_y); constant in the wing frame
  const AddedMass& added_mass() const { return added_mass_; }
  Vec3 wind_w() const { return wind_w_; }
  // radius where the mean speed is taken, from the sweep axis [m]
  double reference_radius() const { return reference_radius_; }

 protected:
  AddedMass added_mass_{};
  Vec3 wind_w_{};
  double reference_radius_ = 0;
};

// A state from outside: one that is not sound becomes all zeros, the beginning of every model.
// Returns its fault, empty where nothing was done.
std::string make_sound(const Air& air, double* state, double dt);

// the motion seen by a fluid that moves with the wind
Motion relative_to_wind(const Motion& motion, Vec3 wind_w);

// the load -A d(v_z, w_x, w_y)/dt
Wrench added_mass_wrench(const AddedMass& added_mass, const Twist& twist_rate);

}  // namespace flaprig
