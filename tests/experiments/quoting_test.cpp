#include "experiments/output/quoting.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "experiments/plot/gnuplot.h"
#include "experiments/plot/plot.h"
#include "mesh/random.h"
#include "mesh/read_file.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

/// Names of bytes 1 to 255 as a file system takes them; `payload` in every other one, where it may run.
std::string random_name(Random& random, const std::string& payload) {
  constexpr std::size_t kMostBytes = 60;
  std::string name;
  while (name.empty() || random.uniform() > 1.0 / kMostBytes) {
    const char byte = static_cast<char>(1 + static_cast<int>(random.uniform() * 255.0));
    if (byte != '/') name += byte;
  }
  if (random.uniform() < 0.5)
    name.insert(static_cast<std::size_t>(random.uniform() * static_cast<double>(name.size())), payload);
  return name;
}

bool is_one_plain_line(const std::string& text) {
  for (unsigned char c : text)
    if (c < 32 || c == 127) return false;
  return true;
}

}  // namespace

TEST_CASE("printable keeps text and shows every other byte") {
  CHECK(printable("horse 1") == "horse 1");
  CHECK(printable("Häuschen−鳥") == "Häuschen−鳥");
  CHECK(printable("a\nb\x1b[31m\x7f") == "a\\x0Ab\\x1B[31m\\x7F");
  CHECK(printable("\xff\xc3") == "\\xFF\\xC3");
  CHECK(printable("\xc0\xaf\xed\xa0\x80\xf4\x90\x80\x80") == "\\xC0\\xAF\\xED\\xA0\\x80\\xF4\\x90\\x80\\x80");
  CHECK(printable("\xc2\x85\xe2\x80\xae") == "\\xC2\\x85\\xE2\\x80\\xAE");
}

TEST_CASE("a file stem is the name where that can stand anywhere, and tells all names apart") {
  for (const char* name : {"horse", "Häuschen", "two words", "a=1,b(2)+c@d~e"}) CHECK(file_stem(name) == name);
  std::set<std::string> stems;
  for (const char* name :
       {"a#b", "a?b", "a%b", "a_b", "a\nb", "a\"b", "a'b", "", ".", "..", "-rf", " a", "a ", "a\xff", "a\xfe"}) {
    const std::string stem = file_stem(name);
    CAPTURE(stem);
    CHECK(stems.insert(stem).second);
    CHECK(stem.find_first_of("#?%\"'\n/\\") == std::string::npos);
    CHECK(stem.front() != '.');
    CHECK(stem.front() != '-');
  }
  CHECK(file_stem(std::string(255, 'x')).size() < 130);
  CHECK(file_stem(std::string(255, 'x')) != file_stem(std::string(254, 'x')));
}

TEST_CASE("each language's quoting, by its rules") {
  CHECK(gnuplot_quoted("it's \"`x`\n") == R"("it's \"\140x\140\\x0A")");
  CHECK(gnuplot_field("a\"b\\") == "\"a''b\\\\\"");
  CHECK(gnuplot_comment("a\nb\\") == "a/x0Ab/");
  CHECK(csv_field("plain") == "plain");
  CHECK(csv_field("a,\"b\r") == "\"a,\"\"b\r\"");
  CHECK(xml_text("<a href=\"x\">&'\x01") == "&lt;a href=&quot;x&quot;&gt;&amp;&#39;\\x01");
  CHECK(json_in_html("{\"</script><!--\": 1}") == "{\"\\u003c/script>\\u003c!--\": 1}");
  CHECK(shell_word("it's $(x)") == "'it'\\''s $(x)'");
}

TEST_CASE("a shell gives a quoted word back as it was, whatever its bytes") {
  const TemporaryFolder folder;
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const std::string name = random_name(random, "$(touch " + folder.file("canary") + ")");
    const std::string command = "printf %s " + shell_word(name) + " > " + shell_word(folder.file("out"));
    REQUIRE(std::system(command.c_str()) == 0);
    CHECK(read_file(folder.file("out")) == name);
  }
  CHECK_FALSE(std::filesystem::exists(folder.file("canary")));
}

TEST_CASE("gnuplot draws a thousand random names and runs none of them") {
  const TemporaryFolder folder;
  const std::string touch = "touch " + folder.file("canary");
  const std::string payloads[] = {"`" + touch + "`", "\nsystem \"" + touch + "\"\n", "'\n!" + touch + "\n#'",
                                  "\\\n!" + touch + "\n", "\"; system(\"" + touch + "\") #"};
  Random random(2);
  constexpr int kNames = 1000, kPanels = 250;
  for (int first = 0; first < kNames; first += kPanels) {
    std::vector<CurveSeries> curves;
    std::string fields, comments;
    for (int i = first; i < first + kPanels; ++i) {
      const std::string name = random_name(random, payloads[i % 5]);
      CurvePoint low, high;
      low.bytes = 256;
      high.bytes = 1024;
      high.psnr_db = 10.0 + i;
      curves.push_back({name, {{0, CurvePoints{low, high}}}});
      fields += gnuplot_field(name) + '\n';
      comments += "# " + gnuplot_comment(name) + '\n';
      CHECK(is_one_plain_line(gnuplot_quoted(name)));
    }
    const std::string model = random_name(random, payloads[0]), name = file_stem(model);
    draw_figure(folder.path().string(), name,
                plot_script(name, {{model, curves}}) + comments + "$names << EOD\n" + fields +
                    "EOD\nset termoption noenhanced\nset output 'names.svg'\nplot $names using (512):(20):1 with "
                    "labels noenhanced\n");
    CHECK(std::filesystem::file_size(folder.file(name + ".svg")) > 1000);
  }
  CHECK_FALSE(std::filesystem::exists(folder.file("canary")));
}
