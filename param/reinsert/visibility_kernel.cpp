#include "param/reinsert/visibility_kernel.h"

#include <algorithm>

#include "param/atlas/triangle_links.h"
#include "param/map/convex_clip.h"

namespace gsp {

namespace {

constexpr double kThinEnough = 1e-3;  // thickness at which a triangle still does: what follows makes it thicker

constexpr Complex kDirection(0.8, 0.6);

}  // namespace

double Kernel::least_thickness(Complex at) const {
  double least = 1.0;
  const std::size_t n = border.size();
  // Around a patch corner of high valence the border can go round a place twice, with all triangles upright.
  const Complex axis = open ? Complex(0.0, 1.0) * (border.front() - border.back()) : kDirection;
  int turns = 0;
  for (std::size_t j = 0; j + (open ? 1 : 0) < n; ++j) {
    const Complex p = border[j], q = border[(j + 1) % n];
    least = std::min(least, thickness(at, p, q));
    turns += cross(p - at, axis) >= 0.0 && cross(axis, q - at) > 0.0;
  }
  return turns == 1 ? least : 0.0;
}

std::optional<Complex> Kernel::place(Complex wanted) const {
  double best = least_thickness(wanted);
  if (best > kThin) return wanted;
  Complex low = border[0], high = border[0];
  for (Complex z : border) {
    low = {std::min(low.real(), z.real()), std::min(low.imag(), z.imag())};
    high = {std::max(high.real(), z.real()), std::max(high.imag(), z.imag())};
  }
  std::vector<Complex> inside{low, {high.real(), low.imag()}, high, {low.real(), high.imag()}};
  for (std::size_t j = 0; j < border.size() && inside.size() > 2; ++j)
    clip_to_left(inside, border[j], border[(j + 1) % border.size()]);
  Complex at = wanted;
  if (inside.size() > 2) {
    Complex middle = 0.0;
    for (Complex z : inside) middle += z / double(inside.size());
    for (double share : {0.5, 1.0}) {
      const Complex trial = wanted + share * (middle - wanted);
      const double thick = least_thickness(trial);
      if (thick <= best) continue;
      best = thick;
      at = trial;
    }
  }
  if (best > kThinEnough) return at;
  return std::nullopt;
}

std::optional<Complex> Kernel::place_on_chord(double wanted) const {
  const Complex from = border.back(), to = border.front();
  double low = 0.0, high = 1.0;
  for (std::size_t j = 0; j + 1 < border.size(); ++j) {
    const double start = cross(border[j + 1] - border[j], from - border[j]);
    const double end = cross(border[j + 1] - border[j], to - border[j]);
    if (start <= 0.0 && end <= 0.0) {
      if (j > 0 && j + 2 < border.size()) return std::nullopt;
      continue;
    }
    if (start < 0.0) low = std::max(low, start / (start - end));
    if (end < 0.0) high = std::min(high, start / (start - end));
  }
  double best = 0.0;
  Complex at;
  for (double share : {wanted, 0.5 * (wanted + 0.5 * (low + high)), 0.5 * (low + high)}) {
    const Complex trial = from + share * (to - from);
    const double thick = least_thickness(trial);
    if (thick <= best || share <= 0.0 || share >= 1.0) continue;
    best = thick;
    at = trial;
    if (best > kThin) break;
  }
  if (best > kThinEnough) return at;
  return std::nullopt;
}

}  // namespace gsp
