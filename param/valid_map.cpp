#include "param/valid_map.h"

#include "mesh/error.h"
#include "param/overlay.h"

namespace gsp {

namespace {
constexpr std::size_t kReportEvery = 1024;
}

Atlas injective_map(std::shared_ptr<const Surface> surface, std::vector<Removal>& removals, Progress& progress) {
  while (true) {
    OverlayMap map(surface);
    std::size_t done = 0;
    try {
      for (; done < removals.size(); ++done) {
        if (done % kReportEvery == 0) progress.report("map without folds", double(done) / removals.size());
        map.remove(removals[done]);
      }
      return map.coarsened();
    } catch (const Error& error) {
      if (error.cause() != Cause::InvalidMap) throw;
      removals.resize(done);
    }
  }
}

}  // namespace gsp
