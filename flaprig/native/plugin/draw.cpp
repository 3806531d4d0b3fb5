// The wake in MuJoCo's viewer and renderers: the faces of the vortex sheet, coloured by circulation.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "../uvlm.hpp"
#include "instance.hpp"

namespace flaprig {
namespace {

struct Colour {
  float r, g, b, a;
};

// blue (negative) through light grey to vermilion (positive), as flaprig/report/style.py:
// M. Okabe & K. Ito, Color universal design (2008)
constexpr Colour kStops[] = {{0.02f, 0.23f, 0.42f, 1}, {0.00f, 0.45f, 0.70f, 1},
                             {0.50f, 0.73f, 0.87f, 1}, {0.91f, 0.93f, 0.93f, 1},
                             {0.95f, 0.70f, 0.50f, 1}, {0.84f, 0.37f, 0.00f, 1},
                             {0.48f, 0.18f, 0.00f, 1}};
constexpr int kPieces = 6;
// the sheet glows a little, so that its far side is not black
constexpr float kEmission = 0.12f;

// strength from -1 to 1; old rings fade, because they fold into each other
Colour colour(double strength, double age) {
  const float x = static_cast<float>(kPieces * (0.5 + 0.5 * std::clamp(strength, -1.0, 1.0)));
  const int i = std::min(static_cast<int>(x), kPieces - 1);
  const float s = x - static_cast<float>(i);
  const Colour &a = kStops[i], &b = kStops[i + 1];
  const auto mix = [s](float from, float to) { return from + s * (to - from); };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b),
          static_cast<float>(0.96 * std::pow(1 - age, 1.4) + 0.02)};
}

// MuJoCo's triangle has corners 0, x and y of its own frame
void triangle(mjvScene* scene, Vec3 a, Vec3 b, Vec3 c, const Colour& rgba) {
  if (scene->ngeom >= scene->maxgeom) return;
  mjvGeom* geom = scene->geoms + scene->ngeom++;
  const Vec3 u = b - a, v = c - a, n = cross(u, v);
  const mjtNum size[3] = {1, 1, 1}, origin[3] = {a.x, a.y, a.z};
  const mjtNum frame[9] = {u.x, v.x, n.x, u.y, v.y, n.y, u.z, v.z, n.z};
  mjv_initGeom(geom, mjGEOM_TRIANGLE, size, origin, frame, &rgba.r);
  geom->category = mjCAT_DECOR;
  geom->emission = kEmission;
}

// nearly the largest: one outlier must not fade the rest
double strong(const double* strengths, int count) {
  std::vector<double> sizes(strengths, strengths + count);
  for (double& size : sizes) size = std::abs(size);
  const auto place = sizes.begin() + (count - 1) * 995 / 1000;
  std::nth_element(sizes.begin(), place, sizes.end());
  return std::max(*place, 1e-12);
}

}  // namespace

void Instance::draw(const mjModel*, const mjData*, mjvScene* scene, Memory memory) const {
  const auto* air = dynamic_cast<const Uvlm*>(air_.get());
  // one that is not sound is cleared in the next step, and that tells
  if (!air || !air->fault(memory.air(), 0).empty()) return;
  Wake wake = air->wake(memory.air());
  const int rows = static_cast<int>(wake.rows()), n = wake.strips;
  if (wake.started() == 0 || rows == 0) return;
  const double* g0 = wake.strengths();
  // a broken wake has no colour
  if (!std::all_of(g0, g0 + rows * n, [](double g) { return std::isfinite(g); })) return;
  const double strongest = strong(wake.strengths(), rows * n);
  // a scene with little room gets fewer and longer faces
  const int room = std::max(1, (scene->maxgeom - scene->ngeom) / (2 * n));
  const int skip = 1 + (rows - 1) / room;
  const double oldest = std::accumulate(wake.ticks(), wake.ticks() + rows, 0.0);
  double age = 0;
  for (int row = 0; row < rows; row += skip) {
    const int next = std::min(row + skip, rows);
    for (int j = 0; j < n; ++j) {
      const double g = wake.strengths()[row * n + j] / strongest;
      const Colour rgba = colour(g, age / oldest);
      const Vec3 a = wake.vertex(row, j), b = wake.vertex(next, j);
      const Vec3 c = wake.vertex(next, j + 1), d = wake.vertex(row, j + 1);
      triangle(scene, a, b, c, rgba);
      triangle(scene, a, c, d, rgba);
    }
    age = std::accumulate(wake.ticks() + row, wake.ticks() + next, age);
  }
}

}  // namespace flaprig
