// What is allowed and yet, most likely, is not what somebody wanted: said when the model is compiled.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "../reader.hpp"
#include "instance.hpp"

namespace flaprig {
namespace {

// By its coefficients and by its size against the wing's: whatever these are, a geom drags its virtual
// mass along and has Stokes's drag. MuJoCo has not found its virtual mass yet when this is asked.
bool is_silent(const mjModel* m, int geom, const Planform& wing) {
  const mjtNum *fluid = m->geom_fluid + mjNFLUID * geom, *size = m->geom_size + 3 * geom;
  // first whether it interacts, then drag and lift
  if (fluid[0] == 0) return true;
  if (std::any_of(fluid + 1, fluid + 6, [](mjtNum c) { return c != 0; })) return false;
  if (m->geom_type[geom] == mjGEOM_MESH) return false;
  const double r = *std::max_element(size, size + 3), chord = wing.mean_chord();
  return 2 * M_PI * r * r * r < 1e-3 * 0.25 * M_PI * chord * wing.area() && 2 * r < 0.05 * wing.span();
}

// whether MuJoCo's fluid acts on the body
bool is_wet(const mjModel* m, int body, const Planform& wing) {
  if (m->opt.density <= 0 && m->opt.viscosity <= 0) return false;
  // what is welded to the world feels no force
  if (m->body_mass[body] < mjMINVAL || m->body_treeid[body] < 0) return false;
  bool ellipsoids = false, silent = true;
  for (int i = 0; i < m->body_geomnum[body]; ++i) {
    const int geom = m->body_geomadr[body] + i;
    ellipsoids = ellipsoids || m->geom_fluid[mjNFLUID * geom] > 0;
    silent = silent && is_silent(m, geom, wing);
  }
  // without ellipsoids the body is a box
  return !ellipsoids || !silent;
}

int mocap_above(const mjModel* m, int body) {
  while (body > 0 && m->body_mocapid[body] < 0) body = m->body_parentid[body];
  return body;
}

}  // namespace

std::vector<std::string> doubts(const mjModel* m, const Place& place, const Planform& wing,
                                Vec3 wind_w) {
  std::vector<std::string> all;
  const std::string body = quoted(m->names + m->name_bodyadr[place.body]);
  if (!place.doubt.empty()) all.push_back(place.doubt);
  if (is_wet(m, place.body, wing)) {
    char option[100];
    std::snprintf(option, sizeof option, "<option density=\"%g\" viscosity=\"%g\">", m->opt.density,
                  m->opt.viscosity);
    all.push_back(
        "MuJoCo's own fluid (" + std::string(option) + ") acts on body " + body +
        " too: set both to 0, or give that body <geom type=\"sphere\" size=\"1e-6\" mass=\"0\" "
        "contype=\"0\" conaffinity=\"0\" fluidshape=\"ellipsoid\" fluidcoef=\"0 0 0 0 0\"/> and no "
        "other fluidshape");
  }
  const Vec3 wind = vec3(m->opt.wind);
  if (norm(wind) > 0 && norm(wind - wind_w) > 0) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "<option wind=\"%g %g %g\"> is the wind of MuJoCo's own fluid; this one's is the "
                  "attribute wind, %g %g %g",
                  wind.x, wind.y, wind.z, wind_w.x, wind_w.y, wind_w.z);
    all.push_back(text);
  }
  if (const int mocap = mocap_above(m, place.body)) {
    all.push_back("body " + quoted(m->names + m->name_bodyadr[mocap]) +
                  " that carries the wing is a mocap body: MuJoCo gives it no velocity, so the fluid "
                  "feels none of its motion; use joints, or weld a body with a freejoint to it");
  }
  return all;
}

}  // namespace flaprig
