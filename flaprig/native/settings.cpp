#include "settings.hpp"

#include <cmath>
#include <stdexcept>

#include "quasi_steady.hpp"
#include "reader.hpp"
#include "uvlm.hpp"

namespace flaprig {
namespace {

// bounds that keep every product finite and every allocation modest
constexpr Range kLength{1e-5, 1e3};
constexpr Range kDensity{0, 1e5, true};
constexpr double kLargestState = 2e7;  // doubles

Vec3 read_wind(const Reader& read) {
  if (!read.has("wind")) return {};
  const std::vector<double> v = read.numbers("wind");
  bool ok = v.size() == 3;
  for (double u : v) ok = ok && std::abs(u) <= 1e3;
  if (!ok) read.refuse("wind", "three numbers within +-1000 m/s");
  return {v[0], v[1], v[2]};
}

std::vector<Station> read_stations(const Reader& read) {
  const std::vector<double> v = read.numbers("stations");
  if (v.size() < 6 || v.size() % 3 != 0 || v.size() > 3000) {
    read.refuse("stations",
                "2 to 1000 triples of numbers \"radius chord leading_edge\" in m");
  }
  std::vector<Station> stations;
  for (size_t i = 0; i < v.size(); i += 3) stations.push_back({v[i], v[i + 1], v[i + 2]});
  return stations;
}

UvlmSettings read_uvlm(const Reader& read) {
  UvlmSettings s;
  s.chordwise = read.integer("chordwise", s.chordwise, 1, 64);
  s.spanwise = read.integer("spanwise", s.spanwise, 1, 128);
  if (s.chordwise * s.spanwise > 1024) {
    read.refuse("spanwise", "at most 1024 over chordwise, " + std::to_string(s.chordwise));
  }
  s.wake_step = read.number("wake_step", s.wake_step, {1e-7, 1e3}, "s");
  s.wake_rows = read.integer("wake_rows", s.wake_rows, 1, 100000);
  if (static_cast<double>(s.wake_rows) * s.spanwise * 4 > kLargestState) {
    read.refuse("wake_rows", "at most 5e6 over spanwise");
  }
  s.wake_detail = read.integer("wake_detail", s.wake_detail, 0, 100000);
  s.wake_fade = read.number("wake_fade", s.wake_fade, {0, 1}, "");
  s.core = read.number("core", s.core, {0, 2, true}, "mean chords");
  s.shedding_fraction = read.number("shedding_fraction", s.shedding_fraction, {0.01, 0.99}, "");
  s.tip_inset = read.number("tip_inset", s.tip_inset, {0, 0.5}, "strips");
  s.rate = static_cast<UvlmSettings::Rate>(
      read.choice("rate", {"ramped", "backward", "second_order"}));
  s.precision =
      static_cast<UvlmSettings::Precision>(read.choice("precision", {"single", "double"}));
  s.suction_efficiency = read.number("suction_efficiency", s.suction_efficiency, {0, 10}, "");
  s.suction_factor = read.number("suction_factor", s.suction_factor, {0, 2}, "");
  s.side_suction_efficiency =
      read.number("side_suction_efficiency", s.side_suction_efficiency, {0, 10}, "");
  s.circulation_lag = read.number("circulation_lag", s.circulation_lag, {0, 10}, "chords");
  s.threads = read.integer("threads", s.threads, 1, 64);
  return s;
}

CoefficientTable read_table(const Reader& read) {
  const std::vector<double> v = read.numbers("coefficient_table");
  bool ok = v.size() >= 6 && v.size() % 3 == 0 && v.size() <= 3000;
  CoefficientTable table;
  for (size_t i = 0; ok && i < v.size(); i += 3) {
    ok = v[i] >= 0 && v[i] <= 3.1416 && (i == 0 || v[i] > v[i - 3]) &&
         std::abs(v[i + 1]) <= 100 && std::abs(v[i + 2]) <= 100;
    table.alpha.push_back(v[i]), table.lift.push_back(v[i + 1]), table.drag.push_back(v[i + 2]);
  }
  if (!ok) {
    read.refuse("coefficient_table",
                "2 to 1000 triples \"alpha lift drag\", alpha rising within 0 to pi rad and the "
                "coefficients within +-100");
  }
  return table;
}

QuasiSteadySettings read_quasi_steady(const Reader& read) {
  using Coefficients = QuasiSteadySettings::Coefficients;
  QuasiSteadySettings s;
  s.strips = read.integer("strips", s.strips, 1, 1000);
  s.coefficients = static_cast<Coefficients>(
      read.choice("coefficients", {"dickinson1999", "lee2016", "table"}));
  s.rotation = read.flag("rotation", s.rotation);
  s.added_mass = read.flag("added_mass", s.added_mass);
  if (s.coefficients == Coefficients::kTable) s.table = read_table(read);
  if (s.coefficients == Coefficients::kLee2016) {
    s.reynolds = read.number("reynolds", 0, {100, 1e7}, "");
    if (s.reynolds == 0) read.refuse("reynolds", "given with coefficients lee2016");
  }
  return s;
}

Planform read_planform(const Reader& read) {
  if (read.has("stations")) {
    for (const char* other : {"span", "chord", "root_offset", "pitch_axis"}) {
      if (read.has(other)) read.refuse(other, "left out when stations are given");
    }
    return Planform(read_stations(read));
  }
  for (const char* needed : {"span", "chord"}) {
    if (!read.has(needed)) read.refuse(needed, "given, in m, unless stations are");
  }
  const double span = read.number("span", 0, kLength, "m");
  const double chord = read.number("chord", 0, kLength, "m");
  const double root = read.number("root_offset", 0, {-1e3, 1e3}, "m");
  const double axis = read.number("pitch_axis", 0.25, {-10, 10}, "chords");
  return Planform({{root, chord, -axis * chord}, {root + span, chord, -axis * chord}});
}

PlateSettings read_plate(const Reader& read) {
  PlateSettings plate;
  plate.site = read.text("site", "");
  plate.thickness = read.number("thickness", plate.thickness, {0, 10}, "m");
  plate.buoyancy = read.flag("buoyancy", plate.buoyancy);
  return plate;
}

void check_names(Model model, const Attributes& attributes) {
  std::string list;
  for (const char* name : attribute_names(model)) {
    list += list.empty() ? name : std::string(", ") + name;
  }
  for (const auto& [name, value] : attributes) {
    bool known = false;
    for (const char* allowed : attribute_names(model)) known = known || name == allowed;
    if (known) continue;
    throw std::invalid_argument("there is no attribute " + quoted(name) + "; use " + list);
  }
}

}  // namespace

// made at first use: the plugins register before this file's constants would exist
const std::vector<const char*>& attribute_names(Model model) {
  static const std::vector<const char*> quasi_steady = {
      "site",     "span",         "chord",             "root_offset", "pitch_axis", "stations",
      "density",  "wind",         "thickness",         "buoyancy",    "strips",     "coefficients",
      "reynolds", "coefficient_table", "rotation",     "added_mass"};
  static const std::vector<const char*> uvlm = {
      "site",     "span",         "chord",             "root_offset", "pitch_axis", "stations",
      "density",  "wind",         "thickness",         "buoyancy",    "chordwise",  "spanwise",
      "wake_step", "wake_rows",   "wake_detail",       "wake_fade",   "core",
      "shedding_fraction",        "tip_inset",         "rate",
      "suction_efficiency",       "suction_factor",    "side_suction_efficiency",
      "circulation_lag",          "precision",         "threads"};
  return model == Model::kUvlm ? uvlm : quasi_steady;
}

Specification read_specification(Model model, const Attributes& attributes) {
  check_names(model, attributes);
  const Reader read(attributes);
  const bool lattice = model == Model::kUvlm;
  return {model,
          read_planform(read),
          read_plate(read),
          read.number("density", 1000, kDensity, "kg/m3"),
          read_wind(read),
          lattice ? read_uvlm(read) : UvlmSettings{},
          lattice ? QuasiSteadySettings{} : read_quasi_steady(read)};
}

int state_size(const Specification& s) {
  if (s.model == Model::kQuasiSteady) return 0;
  const UvlmSettings& u = s.uvlm;
  return Wake(u.chordwise * u.spanwise, u.spanwise, u.wake_rows, u.wake_detail,
              u.circulation_lag > 0, nullptr)
      .state_size();
}

std::unique_ptr<Air> make_air(const Specification& s) {
  if (s.model == Model::kUvlm) {
    return std::make_unique<Uvlm>(s.planform, s.uvlm, s.density, s.wind_w);
  }
  return std::make_unique<QuasiSteady>(s.planform, s.quasi_steady, s.density, s.wind_w);
}

}  // namespace flaprig
