// One wing in a MuJoCo model: where it sits, its air, and what the last `compute` found.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "../air.hpp"
#include "../settings.hpp"
#include "memory.hpp"

namespace flaprig {

Vec3 vec3(const mjtNum* p);
Attributes attributes_of(const mjModel* m, int instance, Model model);
// throws std::invalid_argument when the model's options would make the air's loads wrong
void require_options(const mjModel* m);

// the plugin's name and the instance's, if it has one
std::string title_of(const mjModel* m, int instance, Model model);
// a warning of MuJoCo's with that title
void tell(const mjModel* m, int instance, Model model, const std::string& text);

struct Place {
  int body, site;
  std::string doubt;  // a sentence where the site was guessed
};

// where the instance sits; throws std::invalid_argument with one sentence
Place place_of(const mjModel* m, int instance, const PlateSettings& plate);

// sentences on what is allowed but looks like a mistake
std::vector<std::string> doubts(const mjModel* m, const Place& place, const Planform& wing,
                                Vec3 wind_w);

class Instance {
 public:
  // throws std::invalid_argument with one sentence
  Instance(const mjModel* m, int instance, Model model);

  // A state that no run leaves behind is emptied, and counted in d->warning as MuJoCo counts a bad
  // qacc; the first such warning is printed. Before compute and advance.
  void receive(const mjModel* m, mjData* d, Memory memory) const;
  // the doubts of options that were changed since the model was compiled
  void tell_doubts(const mjModel* m);
  // adds the air's mass to d->M and the rest of its load to d->qfrc_passive
  void compute(const mjModel* m, mjData* d);
  // the step that `compute` began is over: remember its loads, move the wake
  void advance(const mjModel* m, mjData* d, Memory memory);
  // fills the instance's sensors from memory
  void sense(const mjModel* m, mjData* d, Memory memory, bool all) const;
  // takes over what the other's last compute found
  void copy_stage(const Instance& other);
  void draw(const mjModel* m, const mjData* d, mjvScene* scene, Memory memory) const;

 private:
  void check_dofs(const mjModel* m) const;
  void find_jacobian(const mjModel* m, const mjData* d);
  void read_motion(const mjModel* m, const mjData* d);
  void find_load(const mjModel* m, const mjData* d);
  void recover(const mjModel* m, const mjData* d);
  void add_mass(const mjModel* m, mjData* d) const;
  Twist through_jacobian(const mjtNum* velocity) const;
  Wrench buoyancy(const mjModel* m) const;
  Wrench on_mount(const mjModel* m, const Wrench& air, const Twist& rate) const;
  Wrench at_site(const mjModel* m, int site, const Wrench& w) const;
  void log(const mjModel* m, const Wrench& air, const Twist& mean, Memory memory) const;

  int id_, body_, site_;
  Model model_;
  PlateSettings plate_;
  double plate_weight_;  // of the fluid it displaces, per unit gravity [kg]
  Vec3 centroid_;
  std::unique_ptr<Air> air_;
  std::array<double, 5> options_{};  // of MuJoCo's own fluid, when they were last looked at
  std::vector<int> dofs_;  // that move the body, root first

  // of the last compute: rebuilt each step, so no part of the state
  bool computed_ = false;
  Motion motion_;                  // its twist_rate holds what remains at zero qacc
  std::vector<double> ahead_;      // the air's state at this instant, where it prepares
  Wrench velocity_load_;           // all but buoyancy and the added mass on the acceleration
  std::vector<mjtNum> jacobian_;   // 6 x nv, wing axes: linear, then angular
  std::vector<mjtNum> scratch_;    // 6 x nv
};

}  // namespace flaprig
