#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gsp {

/// A part of a page and the mark in the page that stands for it, "@@style.css@@".
struct PagePart {
  std::string_view mark, text;
};

/// Whether the decoder for browsers was compiled into this program, which wants emscripten.
bool has_browser_decoder();

/// A page with its parts in place of their marks: those given, and where they are marked those that pages have in
/// common: style.css, state.js, surface.js, viewer.js, decoder.js, and as base64 of their gzip three.min.js and
/// decoder.wasm, which is empty where there is none. All are compiled in, so that the program needs no folder beside
/// it. `data` is put in last for the mark `data_mark`, as JSON in a script element, since a text in it may look like a
/// mark.
std::string filled_page(std::string_view html, const std::vector<PagePart>& parts, std::string_view data_mark,
                        const std::string& data);

}  // namespace gsp
