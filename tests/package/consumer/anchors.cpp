#include <gsp/coder/anchors.h>
#include <gsp/mesh/shapes.h>

int main() {
  const gsp::Mesh sphere = gsp::shapes::sphere(3);
  gsp::Progress silent;
  const auto smaller = gsp::decimate(sphere, {200}, gsp::Decimation::Volume, silent);
  const gsp::AnchorPoint point = gsp::draco_round_trip(smaller.front(), 10);
  return point.faces <= 200 && point.bytes > 0 ? 0 : 1;
}
