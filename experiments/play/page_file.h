#pragma once

#include <string_view>

// A file that is compiled into the program (gsp_page_files in CMakeLists.txt), by its name with _ for dots: declared
// outside of any namespace, and its bytes.
#define GSP_PAGE_FILE(name)                \
  extern "C" const char gsp_page_##name[]; \
  extern "C" const char gsp_page_##name##_end[]
#define GSP_PAGE_TEXT(name) \
  std::string_view(gsp_page_##name, static_cast<std::size_t>(gsp_page_##name##_end - gsp_page_##name))
