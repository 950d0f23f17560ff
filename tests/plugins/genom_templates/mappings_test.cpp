// The headers for codels in C are compiled, as C and as C++, with what codels do; and their types are as large as the
// description says.

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "plugins/genom_description/description.h"
#include "plugins/genom_templates/template_run.h"
#include "tests/support/temporary_folder.h"

namespace runnel::genom {
namespace {

constexpr const char* kDescription =
    "module m { enum e { A, B }; struct tree; typedef sequence<tree> trees; struct tree { trees under; long v[2][3]; "
    "};\n"
    "  union u switch(e) { case A: string<4> s; default: tree t; }; const double half = 0.5; const boolean yes = "
    "TRUE;\n"
    "  const string said = \"a \\\"word\\\"\nin two lines\"; const char letter = 'x'; const char quote = \"\\\"\";\n"
    "  typedef string<8> name; typedef double row[3]; typedef sequence<row, 2> rows; typedef optional<u> maybe; };\n"
    "interface other { function f(in m::u a, out m::name n, in string s, out double d); };\n"
    "component c { uses other; native tool; exception late { double by; }; exception lost;\n"
    "  ids { tool own; m::trees ts; m::u uu; m::rows r; m::maybe o; string s; struct part { octet a; short b; } "
    "parts[2];\n"
    "        sequence<sequence<long, 2>, 3> deep; sequence<string> texts; sequence<m::name> names; };\n"
    "  port in m::u p; port out m::row w; port multiple out m::name q; task t;\n"
    "  activity a(in sequence<double> z, in m::e k, out string x, inout m::row row) { task t; throw late, lost;\n"
    "    codel<start> filled(in own, out own::made, inout ts, in uu, out s, in k, in z, in p, out w, port out q, in "
    "f,\n"
    "                        out x, inout row, in ::all) yield pause::start, ether; }; };\n";

constexpr const char* kFilled =
    "#include \"acc.h\"\n#include \"c_c_types.h\"\n"
    "struct c_tool { int turns; };\n"
    "genom_event\n"
    "filled(const c_tool *own, c_tool **made, m_trees *ts, const m_u *uu, char **s, m_e k, const sequence_double *z,\n"
    "       const c_p *p, const c_w *w, const c_q *q, const c_f *f, char **x, double row[3], const c_ids *all,\n"
    "       const genom_context self)\n{\n"
    "  const m_u *seen;\n  m_name name;\n  double d;\n  c_late_detail detail;\n  genom_event e;\n"
    "  if (genom_sequence_reserve(ts, 3)) return c_lost(self);\n"
    "  ts->_buffer[0].v[1][2] = (int32_t)z->_length + (uu->_d == m_A ? uu->_u.s[0] : uu->_u.t.v[0][0]);\n"
    "  e = (*p->read)(self);\n  if (e != genom_ok) return e;\n  seen = p->data(self);\n  if (!seen) return "
    "c_pause_start;\n"
    "  w->data(self)[0][1] = m_half;\n  w->write(self);\n"
    "  q->open(\"one\", self);\n  (*q->data(\"one\", self))[0] = 'x';\n"
    "  e = f->call(seen, name, *s, &d, self);\n  detail.by = d + row[0];\n"
    "  if (k == m_B && all->o._present && m_yes) return c_late(&detail, self);\n"
    "  *x = *s;\n  *made = (c_tool *)0;\n  return own && m_said[2] == m_quote && m_letter == 'x' ? c_ether : e;\n}\n";

bool Compiles(const std::filesystem::path& folder, const std::string& compiler, const std::string& file) {
  return std::system(("cd '" + folder.string() + "' && " + compiler + " -Wall -Wextra -Werror -fsyntax-only " + file)
                         .c_str()) == 0;
}

TEST(MappingsTest, CodelsInCAndCppCompileAgainstThem) {
  if (std::system("cc --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no C compiler";
  Diagnostics diagnostics;
  const auto description = ReadDescriptionText(kDescription, "test.gen", {}, diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  const std::string model = DescriptionJson(*description);
  const auto output = RunTemplate(std::string(RUNNEL_GENOM_TEMPLATE_FOLDER) + "/mappings", model, {});
  ASSERT_TRUE(output) << output.error().ToString();
  const test::TemporaryFolder folder;
  (void)WriteFiles(folder.path(), output->files, WhatIsThere::kIsMerged, diagnostics);

  std::ofstream(folder.path() / "filled.c") << kFilled;
  EXPECT_TRUE(Compiles(folder.path(), "cc -std=c11", "filled.c"));
  EXPECT_TRUE(Compiles(folder.path(), "c++ -std=c++17 -x c++", "filled.c"));

  std::ofstream sizes(folder.path() / "sizes.c");
  sizes << "#include \"c_c_types.h\"\n";
  int count = 0;
  const auto json = nlohmann::json::parse(model);
  for (const auto& type : json["types"]) {
    if (type["kind"] == "constant" || type["kind"] == "exception" || type["kind"] == "native type") continue;
    std::string name = type["name"];
    for (std::size_t at = 0; (at = name.find("::")) != std::string::npos;) name.replace(at, 2, "_");
    sizes << "_Static_assert(sizeof(" << name << ") == " << type["size"] << ", \"" << name << "\");\n";
    sizes << "_Static_assert(_Alignof(" << name << ") == " << type["alignment"] << ", \"" << name << "\");\n";
    ++count;
  }
  sizes.close();
  EXPECT_GT(count, 8);
  EXPECT_TRUE(Compiles(folder.path(), "cc -std=c11", "sizes.c"));
}

}  // namespace
}  // namespace runnel::genom
