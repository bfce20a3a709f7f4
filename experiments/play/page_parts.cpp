#include "experiments/play/page_parts.h"

#include "experiments/output/base64.h"
#include "experiments/output/quoting.h"
#include "experiments/play/page_file.h"

GSP_PAGE_FILE(style_css);
GSP_PAGE_FILE(three_min_js_gz);
GSP_PAGE_FILE(state_js);
GSP_PAGE_FILE(surface_js);
GSP_PAGE_FILE(viewer_js);
GSP_PAGE_FILE(decoder_js);
GSP_PAGE_FILE(decoder_wasm_gz);

namespace gsp {

namespace {

void replace(std::string& page, std::string_view mark, std::string_view text) {
  if (const std::size_t place = page.find(mark); place != std::string::npos) page.replace(place, mark.size(), text);
}

}  // namespace

bool has_browser_decoder() { return !GSP_PAGE_TEXT(decoder_wasm_gz).empty(); }

std::string filled_page(std::string_view html, const std::vector<PagePart>& parts, std::string_view data_mark,
                        const std::string& data) {
  const std::string three = base64(GSP_PAGE_TEXT(three_min_js_gz)), decoder = base64(GSP_PAGE_TEXT(decoder_wasm_gz));
  std::string page(html);
  for (const auto& [mark, text] : parts) replace(page, mark, text);
  for (const auto& [mark, text] :
       {PagePart{"@@style.css@@", GSP_PAGE_TEXT(style_css)}, PagePart{"@@three.min.js@@", three},
        PagePart{"@@state.js@@", GSP_PAGE_TEXT(state_js)}, PagePart{"@@surface.js@@", GSP_PAGE_TEXT(surface_js)},
        PagePart{"@@viewer.js@@", GSP_PAGE_TEXT(viewer_js)}, PagePart{"@@decoder.js@@", GSP_PAGE_TEXT(decoder_js)},
        PagePart{"@@decoder.wasm@@", decoder}})
    replace(page, mark, text);
  replace(page, data_mark, json_in_html(data));
  return page;
}

}  // namespace gsp
