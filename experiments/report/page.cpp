#include "experiments/report/page.h"

#include <string_view>

#include "experiments/output/quoting.h"

// Each file of the page as its bytes (page_files.S.in).
#define GSP_PAGE_FILE(name)                \
  extern "C" const char gsp_page_##name[]; \
  extern "C" const char gsp_page_##name##_end[]
GSP_PAGE_FILE(index);
GSP_PAGE_FILE(style);
GSP_PAGE_FILE(three);
GSP_PAGE_FILE(state);
GSP_PAGE_FILE(chart);
GSP_PAGE_FILE(surface);
GSP_PAGE_FILE(viewer);
GSP_PAGE_FILE(page);
#undef GSP_PAGE_FILE

namespace gsp {

namespace {

/// A file and the mark in index.html that stands for it.
struct Part {
  std::string_view mark;
  const char* begin;
  const char* end;
};

const Part kParts[] = {{"@@style.css@@", gsp_page_style, gsp_page_style_end},
                       {"@@three.min.js@@", gsp_page_three, gsp_page_three_end},
                       {"@@state.js@@", gsp_page_state, gsp_page_state_end},
                       {"@@chart.js@@", gsp_page_chart, gsp_page_chart_end},
                       {"@@surface.js@@", gsp_page_surface, gsp_page_surface_end},
                       {"@@viewer.js@@", gsp_page_viewer, gsp_page_viewer_end},
                       {"@@page.js@@", gsp_page_page, gsp_page_page_end}};

void replace(std::string& page, std::string_view mark, std::string_view text) {
  page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string report_page(const std::string& run_json) {
  std::string page(gsp_page_index, gsp_page_index_end);
  for (const Part& part : kParts)
    replace(page, part.mark, {part.begin, static_cast<std::size_t>(part.end - part.begin)});
  // Last, since a name in it may look like a mark.
  replace(page, "@@run.json@@", json_in_html(run_json));
  return page;
}

}  // namespace gsp
