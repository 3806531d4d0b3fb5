// The settings of both air models and their reading from text attributes: one table serves
// the MuJoCo plugins and Python, so that a model file and a script mean the same.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "air.hpp"
#include "planform.hpp"
#include "vec3.hpp"

namespace flaprig {

struct UvlmSettings {
  // how dGw/dt is told from the last two intervals: ramped from the one to the other, a step and a
  // half late but smooth (docs/model.md); the last one (Katz & Plotkin); carried on to second order
  enum class Rate { kRamped, kBackward, kSecondOrder };
  // of the roll-up's velocities
  enum class Precision { kSingle, kDouble };
  int chordwise = 6, spanwise = 12;
  double wake_step = 0.05;             // time between wake rows [s]
  int wake_rows = 100;                 // frozen rows kept
  double wake_fade = 0.1;              // share of them, the oldest, that fades to nothing
  double core = 0.15;                  // vortex core radius [mean chords]
  double shedding_fraction = 1.0 / 3;  // of the way to the last free row (Ramesh 2014)
  int wake_detail = 50;                // rows that are young (roll_up.hpp); 0: all are, for ever
  double tip_inset = 0.25;             // of a strip
  Rate rate = Rate::kRamped;
  double suction_efficiency = 0.7;     // eta_s of eq. 6, calibrated: docs/model.md
  double suction_factor = 1;           // 1: eq. 6 as printed; 4/pi: exact flat-plate suction
  double side_suction_efficiency = 0;  // the same of the tips, as a share of the exact suction
  double circulation_lag = 0;          // travel in which the loads' circulation builds up [chords]
  Precision precision = Precision::kSingle;
  int threads = 1;
};

// lift and drag coefficients against the angle of attack [rad], linear between the rows
struct CoefficientTable {
  std::vector<double> alpha, lift, drag;
};

struct QuasiSteadySettings {
  enum class Coefficients { kDickinson1999, kLee2016, kTable };
  int strips = 24;
  Coefficients coefficients = Coefficients::kDickinson1999;
  CoefficientTable table;
  double reynolds = 0;  // at R2, for Lee 2016
  bool rotation = true, added_mass = true;
};

struct PlateSettings {
  std::string site;
  double thickness = 0.003;  // [m]
  bool buoyancy = false;
};

using Attributes = std::map<std::string, std::string>;

enum class Model { kQuasiSteady, kUvlm };
constexpr const char* kModelNames[] = {"flaprig.quasi_steady", "flaprig.uvlm"};

// attribute names of a model, in the order of its README
const std::vector<const char*>& attribute_names(Model model);

// all that the attributes say
struct Specification {
  Model model;
  Planform planform;
  PlateSettings plate;
  double density;
  Vec3 wind_w;
  UvlmSettings uvlm;
  QuasiSteadySettings quasi_steady;
};

// throws std::invalid_argument with one sentence that names the attribute, its value and what is
// allowed
Specification read_specification(Model model, const Attributes& attributes);
// doubles that the model will remember
int state_size(const Specification& specification);
std::unique_ptr<Air> make_air(const Specification& specification);

}  // namespace flaprig
