#include "param/valid_map.h"

#include "param/overlay.h"

namespace gsp {

namespace {
constexpr std::size_t kReportEvery = 1024;
}

Atlas injective_map(std::shared_ptr<const Surface> surface, const std::vector<Removal>& removals, Progress& progress) {
  OverlayMap map(std::move(surface));
  for (std::size_t i = 0; i < removals.size(); ++i) {
    if (i % kReportEvery == 0) progress.report("map without folds", double(i) / removals.size());
    map.remove(removals[i]);
  }
  return map.coarsened();
}

}  // namespace gsp
