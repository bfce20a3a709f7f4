#include "experiments/play/play.h"

#include <nlohmann/json.hpp>

#include "experiments/figures/remesh_map.h"
#include "experiments/output/base64.h"
#include "experiments/output/quoting.h"
#include "experiments/play/page_file.h"
#include "experiments/play/page_parts.h"
#include "experiments/play/view_frame.h"
#include "mesh/error.h"

GSP_PAGE_FILE(play_html);
GSP_PAGE_FILE(play_js);

namespace gsp {

namespace {

constexpr long long kMostFaces = 1 << 19;

}  // namespace

PlayPage play_page(const Bytes& stream, const std::string& title) {
  if (!has_browser_decoder())
    throw Error(Cause::ToolMissing,
                "this gsp was built without the decoder for browsers: install emscripten (Debian: apt-get install "
                "emscripten), configure again and build");
  PlayPage page;
  page.header_bytes = header_bytes(stream);
  const SemiregularMesh whole = decode(stream, stream.size());
  page.level = whole.level;
  page.shown_level = level_within(whole, kMostFaces);
  page.vertices = whole.positions.size();

  const SemiregularMesh shown = at_level(whole, page.shown_level);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : shown.positions) box.extend(p);
  nlohmann::ordered_json view = view_frame(shown.mesh(), remesh_as_map(at_level(whole, 0)).base, box, page.shown_level);
  view["name"] = printable(title);
  view["stream_level"] = page.level;
  view["header_bytes"] = page.header_bytes;
  view["bytes"] = stream.size();
  view["streams"] = {base64(stream)};
  page.html =
      filled_page(GSP_PAGE_TEXT(play_html), {{"@@play.js@@", GSP_PAGE_TEXT(play_js)}}, "@@played.json@@", view.dump());
  return page;
}

}  // namespace gsp
