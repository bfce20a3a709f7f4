#pragma once

#include <string>

namespace gsp {

// Names of models are file names, and those may hold any bytes. Where a name or a sentence with one in it goes into
// another language, it goes through that language's function here. SQL is not among them: there every value is bound.

/// One line of UTF-8 for people: control characters and bytes that are no UTF-8 become \xHH, the rest stays.
std::string printable(const std::string& text);

/// The name of a model as a file name without ending, to be used in paths, URLs and gnuplot: itself where it is made of
/// letters, digits, spaces inside, printable characters beyond ASCII and . _ - + = @ , ~ ( ); else with _ for what is
/// not, cut to 100 bytes, and with a hash of the whole behind it, so that distinct names stay distinct.
std::string file_stem(const std::string& name);

/// A text as a string of gnuplot's, quotes included, in which nothing is expanded; `printable`.
std::string gnuplot_quoted(const std::string& text);
/// A text as a field of gnuplot's inline data, in double quotes; `printable`.
std::string gnuplot_field(const std::string& text);
/// A text behind # in a gnuplot program: neither a line break nor a backslash, which would join the next line to it.
std::string gnuplot_comment(const std::string& text);

/// A field of a CSV line (RFC 4180): in quotes where it holds a comma, a quote or a line break or begins
/// with #, which some readers take for a comment; with all its bytes.
std::string csv_field(const std::string& text);

/// A text between tags or in an attribute's double quotes of XML and HTML; `printable`.
std::string xml_text(const std::string& text);

/// JSON as the content of an HTML script element, which no text in it can end.
std::string json_in_html(const std::string& json);

/// One word of a shell's command line.
std::string shell_word(const std::string& text);

}  // namespace gsp
