#include "experiments/report/page.h"

#include "experiments/play/page_file.h"
#include "experiments/play/page_parts.h"

GSP_PAGE_FILE(index_html);
GSP_PAGE_FILE(chart_js);
GSP_PAGE_FILE(page_js);

namespace gsp {

std::string report_page(const std::string& run_json) {
  return filled_page(GSP_PAGE_TEXT(index_html),
                     {{"@@chart.js@@", GSP_PAGE_TEXT(chart_js)}, {"@@page.js@@", GSP_PAGE_TEXT(page_js)}},
                     "@@run.json@@", run_json);
}

}  // namespace gsp
