// The wake in MuJoCo's viewer and renderers: lines across and along the vortex sheet.

#include <algorithm>
#include <cmath>

#include "../uvlm.hpp"
#include "instance.hpp"

namespace flaprig {
namespace {

void line(mjvScene* scene, Vec3 a, Vec3 b, const float rgba[4]) {
  if (scene->ngeom >= scene->maxgeom) return;
  mjvGeom* geom = scene->geoms + scene->ngeom++;
  mjv_initGeom(geom, mjGEOM_LINE, nullptr, nullptr, nullptr, rgba);
  const mjtNum from[3] = {a.x, a.y, a.z}, to[3] = {b.x, b.y, b.z};
  mjv_connector(geom, mjGEOM_LINE, 1.5, from, to);
  geom->category = mjCAT_DECOR;
}

// orange for positive, blue for negative circulation, fading with age
void colour(double strength, double age, float rgba[4]) {
  const float s = static_cast<float>(std::clamp(strength, -1.0, 1.0));
  const float pale = 0.75f * (1 - std::abs(s));
  rgba[0] = s > 0 ? 0.90f : pale + 0.1f;
  rgba[1] = std::max(pale, 0.45f);
  rgba[2] = s > 0 ? pale : 0.85f;
  rgba[3] = static_cast<float>(0.9 - 0.7 * age);
}

}  // namespace

void Instance::draw(const mjModel*, const mjData*, mjvScene* scene, Memory memory) const {
  const auto* air = dynamic_cast<const Uvlm*>(air_.get());
  if (!air) return;
  Wake wake = air->wake(memory.air());
  const int rows = static_cast<int>(wake.rows()), n = wake.strips;
  if (wake.started() == 0 || rows == 0) return;
  double strongest = 1e-12;
  for (int k = 0; k < rows * n; ++k) strongest = std::max(strongest, std::abs(wake.strengths()[k]));
  // lines along and across; the scene's room decides how many rows are left out
  const int room = std::max(1, (scene->maxgeom - scene->ngeom) / (2 * n + 2));
  const int skip = 1 + rows / room;
  for (int row = 0; row + skip <= rows; row += skip) {
    for (int j = 0; j <= n; ++j) {
      float rgba[4];
      const double g = wake.strengths()[row * n + std::min(j, n - 1)];
      colour(g / strongest, static_cast<double>(row) / rows, rgba);
      line(scene, wake.vertex(row, j), wake.vertex(row + skip, j), rgba);
      if (j < n) line(scene, wake.vertex(row, j), wake.vertex(row, j + 1), rgba);
    }
  }
}

}  // namespace flaprig
