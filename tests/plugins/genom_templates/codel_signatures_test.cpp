// Codels written for the original tool compile against the headers: each kind of codel with parameters of each type and
// direction, in C and in C++, without a warning.

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>

#include "plugins/genom_description/description.h"
#include "plugins/genom_templates/template_run.h"
#include "tests/support/temporary_folder.h"

namespace runnel::genom {
namespace {

struct Mapped {
  std::string type;    // in the description
  std::string input;   // of a codel, "@" being the name
  std::string output;  // and for inout
};

const std::vector<Mapped> kMapped = {
    {"boolean", "bool @", "bool *@"},
    {"octet", "uint8_t @", "uint8_t *@"},
    {"char", "char @", "char *@"},
    {"short", "int16_t @", "int16_t *@"},
    {"unsigned short", "uint16_t @", "uint16_t *@"},
    {"long", "int32_t @", "int32_t *@"},
    {"unsigned long", "uint32_t @", "uint32_t *@"},
    {"long long", "int64_t @", "int64_t *@"},
    {"unsigned long long", "uint64_t @", "uint64_t *@"},
    {"float", "float @", "float *@"},
    {"double", "double @", "double *@"},
    {"string", "const char *@", "char **@"},
    {"string<8>", "const char @[8]", "char @[8]"},
    {"m::side", "m_side @", "m_side *@"},
    {"m::point", "const m_point *@", "m_point *@"},
    {"m::target", "const m_target *@", "m_target *@"},
    {"m::speed", "m_speed @", "m_speed *@"},
    {"m::name", "const m_name @", "m_name @"},
    {"m::row", "const double @[3]", "double @[3]"},
    {"m::grid", "const int32_t @[2][3]", "int32_t @[2][3]"},
    {"m::route", "const m_route *@", "m_route *@"},
    {"m::maybe", "const m_maybe *@", "m_maybe *@"},
    {"sequence<long, 4>", "const sequence4_long *@", "sequence4_long *@"},
    {"sequence<double>", "const sequence_double *@", "sequence_double *@"},
    {"sequence<m::point>", "const sequence_m_point *@", "sequence_m_point *@"},
    {"sequence<string<8>, 2>", "const sequence2_string8 *@", "sequence2_string8 *@"},
    {"sequence<string>", "const sequence_string *@", "sequence_string *@"},
    {"sequence<sequence<octet, 2>, 3>", "const sequence3_sequence2_octet *@", "sequence3_sequence2_octet *@"},
    {"optional<double>", "const optional_double *@", "optional_double *@"},
    {"optional<m::point>", "const optional_m_point *@", "optional_m_point *@"},
    {"sequence<short>", "const sequence_short *@", "sequence_short *@"},
    {"sequence<octet, 3>", "const sequence3_octet *@", "sequence3_octet *@"},
    {"sequence<unsigned long>", "const sequence_unsigned_long *@", "sequence_unsigned_long *@"},
    {"sequence<unsigned long long, 2>", "const sequence2_unsigned_long_long *@", "sequence2_unsigned_long_long *@"},
    {"sequence<boolean>", "const sequence_boolean *@", "sequence_boolean *@"},
    {"optional<long>", "const optional_long *@", "optional_long *@"},
};

std::string Named(std::string text, const std::string& name) { return text.replace(text.find('@'), 1, name); }

/// A description and the codels that its author has written, side by side.
class Component {
 public:
  explicit Component(const std::vector<std::string>& directions) {
    std::string ids, locals, uses, local_uses, parameters, local_parameters;
    for (std::size_t i = 0; i < kMapped.size(); ++i) {
      const std::string number = std::to_string(i), &direction = directions[i % directions.size()];
      const std::string& mapped = direction == "in" ? kMapped[i].input : kMapped[i].output;
      ids += kMapped[i].type + " d" + number + "; ";
      locals += (i == 0 ? "" : ", ") + direction + " " + kMapped[i].type + " p" + number;
      uses += (i == 0 ? "" : ", ") + direction + " d" + number;
      local_uses += (i == 0 ? "" : ", ") + ("local " + direction) + " p" + number;
      parameters += Named(mapped, "d" + number) + ", ";
      local_parameters += Named(mapped, "p" + number) + ", ";
      body_ += "  (void)d" + number + ";\n";
      local_body_ += "  (void)p" + number + ";\n";
    }
    description_ =
        "module m { enum side { left, right }; struct point { double x, y; }; typedef float speed; typedef string<8> "
        "name;\n"
        " typedef double row[3]; typedef long grid[2][3]; typedef sequence<point, 4> route; typedef optional<point> "
        "maybe;\n"
        " union target switch (side) { case left: point where; default: string<16> name; }; };\n"
        "component c { native tool; exception late; exception slow { double by; };\n"
        " ids { " +
        ids + "tool own; };\n task t { period 10 ms; codel<start> t_start(" + uses +
        ") yield go;\n"
        "  codel<go> t_go(in own, out own::made) yield pause::go, ether; codel<stop> t_stop(out ::ids) yield ether; "
        "};\n"
        " attribute set(in d0, in d13) { validate a_check(local in d0, local in d13); };\n"
        " function f(" +
        locals + ") { validate f_check(" + local_uses + "); codel f_do(" + uses +
        "); throw late; };\n"
        " activity a(" +
        locals + ") { task t; local double left; validate a_ok(" + local_uses +
        ");\n"
        "  codel<start> a_start(" +
        uses + ", out left) yield more; codel<more> a_more(" + local_uses +
        ", inout left) yield "
        "pause::more, ether; throw late, slow; };\n};\n";
    Add("t_start", parameters, body_, "c_go");
    Add("t_go", "const c_tool *own, c_tool **made, ", "  *made = (c_tool *)0;\n  if (!own) return c_pause_go;\n",
        "c_ether");
    Add("t_stop", "c_ids *ids, ", "  ids->d0 = true;\n", "c_ether");
    Add("a_check", "bool d0, m_side d13, ", "  if (d0 && d13 == m_right) return c_late(self);\n", "genom_ok");
    Add("f_check", local_parameters, local_body_, "genom_ok");
    Add("f_do", parameters, body_, "genom_ok");
    Add("a_ok", local_parameters, local_body_, "genom_ok");
    Add("a_start", parameters + "double *left, ", body_ + "  *left = 1;\n", "c_more");
    Add("a_more", local_parameters + "double *left, ",
        local_body_ +
            "  c_slow_detail slow;\n  genom_syserr_detail error = { 5 };\n"
            "  if (*left < 0) { slow.by = *left; return c_slow(&slow, self); }\n"
            "  if (*left > 9) return genom_syserr(&error, self);\n",
        "*left > 0 ? c_ether : c_pause_more");
  }
  [[nodiscard]] const std::string& description() const { return description_; }
  [[nodiscard]] const std::string& codels() const { return codels_; }

 private:
  void Add(const std::string& name, const std::string& parameters, const std::string& body, const std::string& result) {
    codels_ += "genom_event\n" + name + "(" + parameters + "const genom_context self)\n{\n  (void)self;\n" + body +
               "  return " + result + ";\n}\n";
  }
  std::string description_, body_, local_body_;
  std::string codels_ = "#include \"acc.h\"\n\n#include \"c_c_types.h\"\n\n";
};

void ExpectCompiles(const std::string& description, const std::string& codels,
                    const std::vector<std::string>& compilers = {"gcc -std=c99", "gcc -std=gnu17",
                                                                 "g++ -std=c++17 -x c++", "g++ -std=c++20 -x c++"}) {
  Diagnostics diagnostics;
  const auto read = ReadDescriptionText(description, "c.gen", {}, diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  const auto output = RunTemplate(RUNNEL_GENOM_TEMPLATE_FOLDER "/mappings", DescriptionJson(*read), {});
  ASSERT_TRUE(output) << output.error().ToString();
  const test::TemporaryFolder folder;
  (void)WriteFiles(folder.path(), output->files, WhatIsThere::kIsMerged, diagnostics);
  std::ofstream(folder.path() / "codels.c") << codels;
  for (const std::string& compiler : compilers) {
    const std::string command =
        "cd '" + folder.path().string() + "' && " + compiler + " -Wall -Wextra -Werror -fsyntax-only codels.c 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << compiler << "\n" << description << codels;
    if (testing::Test::HasFailure()) return;
  }
}

bool HasCompilers() { return std::system("gcc --version > /dev/null 2>&1 && g++ --version > /dev/null 2>&1") == 0; }

TEST(CodelSignaturesTest, OfEachKindWithEachTypeAndDirection) {
  if (!HasCompilers()) GTEST_SKIP() << "there is no compiler";
  for (const auto& directions : std::vector<std::vector<std::string>>{{"in"}, {"out"}, {"inout"}}) {
    const Component component(directions);
    ExpectCompiles(component.description(), component.codels());
  }
}

// Ports and remotes, and what is done with them and with sequences.
TEST(CodelSignaturesTest, OfPortsRemotesAndSequences) {
  if (!HasCompilers()) GTEST_SKIP() << "there is no compiler";
  ExpectCompiles(
      "struct frame { sequence<octet> pixels; unsigned long width; enum kind_e { grey, colour } kind; }; typedef "
      "double metres;\n"
      "interface light { function set(in double level, out boolean was); };\n"
      "component c { uses light; port in frame seen; port out frame shown; port multiple out frame each; port multiple "
      "in metres range;\n"
      " ids { frame frame; sequence<frame> all; }; task t;\n"
      " activity a() { task t; codel<start> go(in seen, out shown, out each, in range, in set, out frame, out all) "
      "yield ether; }; };\n",
      "#include \"acc.h\"\n#include \"c_c_types.h\"\n"
      "genom_event\ngo(const c_seen *seen, const c_shown *shown, const c_each *each,\n   const c_range *range, const "
      "c_set *set, "
      "frame *f,\n   sequence_frame *all, const genom_context self)\n{\n"
      "  bool was = false;\n  genom_event e = seen->read(self);\n  const double *far;\n"
      "  if (e) return e == genom_syserr_id ? c_ether : e;\n  if (!seen->data(self)) return c_ether;\n"
      "  if (genom_sequence_reserve(&(f->pixels), 3 * 4) == -1) return c_ether;\n"
      "  f->pixels._length = 12;\n  f->kind = f->width ? frame_colour : f->kind;\n"
      "  (void)genom_sequence_reserve(&(f->pixels), 0);\n  if (genom_sequence_reserve(all, all->_length + 1)) return "
      "c_ether;\n"
      "  genom_sequence_reserve(all, 2);\n  all->_buffer[all->_length++].width = 4;\n"
      "  *shown->data(self) = *f;\n  shown->write(self);\n  each->open(\"left\", self);\n"
      "  each->data(\"left\", self)->width = 2;\n  each->write(\"left\", self);\n  each->close(\"left\", self);\n"
      "  range->read(\"one\", self);\n  far = range->data(\"one\", self);\n"
      "  return set->call(far ? *far : 0.5, &was, self) == genom_ok ? c_ether : c_ether;\n}\n");
}

// The original's headers bring what `errno` is.
TEST(CodelSignaturesTest, NoHeaderIsNeededForErrorsOfTheSystem) {
  if (!HasCompilers()) GTEST_SKIP() << "there is no compiler";
  ExpectCompiles("component c { task t { codel<start> go() yield ether; }; };\n",
                 "#include \"acc.h\"\n#include \"c_c_types.h\"\n"
                 "genom_event go(const genom_context self)\n{\n  genom_syserr_detail detail = { errno };\n"
                 "  return detail.code == EAGAIN ? genom_syserr(&detail, self) : c_ether;\n}\n");
}

// Those of interfaces have the names of both.
TEST(CodelSignaturesTest, PortsOfInterfacesHaveTheirNames) {
  if (!HasCompilers()) GTEST_SKIP() << "there is no compiler";
  const std::string interface =
      "typedef double turns; interface rotor { port in turns wish; port out turns speed; };\n";
  const std::string component = " provides rotor; task t { codel<start> go(in wish, out speed) yield ether; }; };\n";
  ExpectCompiles(interface + "component c {" + component,
                 "#include \"acc.h\"\n#include \"c_c_types.h\"\n"
                 "genom_event go(const rotor_wish *wish, const c_speed *speed, const genom_context self)\n{\n"
                 "  const rotor_speed *same = speed;\n  if (wish->data(self)) *same->data(self) = *wish->data(self);\n"
                 "  return c_ether;\n}\n");
  ExpectCompiles(interface + "component c { lang \"c++\";" + component,
                 "#include \"acc.h\"\n#include \"c_cxx_types.h\"\n"
                 "genom::event go(rotor::wish &wish, c::speed &speed)\n{\n  rotor::speed &same = speed;\n"
                 "  same.data() = wish.data();\n  return c::ether;\n}\n",
                 {"g++ -std=c++11 -x c++"});
}

// It stands for its detail.
TEST(CodelSignaturesTest, AnExceptionWithinAnotherOne) {
  if (!HasCompilers()) GTEST_SKIP() << "there is no compiler";
  const std::string description =
      " exception cause { long code; }; exception failed { cause why; sequence<cause, 2> before; };\n"
      " struct note { cause last; }; ids { note seen; };\n"
      " function f() { codel f_do(in seen); throw failed; }; };\n";
  ExpectCompiles("component c {" + description,
                 "#include \"acc.h\"\n#include \"c_c_types.h\"\n"
                 "genom_event f_do(const c_note *seen, const genom_context self)\n{\n  c_failed_detail detail;\n"
                 "  c_cause_detail cause = { 2 };\n  detail.why = seen->last;\n  detail.before._length = 1;\n"
                 "  detail.before._buffer[0] = cause;\n  return c_failed(&detail, self);\n}\n");
  ExpectCompiles(
      "component c { lang \"c++\";" + description,
      "#include \"acc.h\"\n#include \"c_cxx_types.h\"\n"
      "genom::event f_do(const c::note &seen)\n{\n  c::failed failed;\n  failed.detail.why = seen.last;\n"
      "  failed.detail.before.push_back(seen.last);\n  if (seen.last.code) throw failed;\n  return genom::ok;\n}\n",
      {"g++ -std=c++11 -x c++", "g++ -std=c++20 -x c++"});
}

// With lang "c++": namespaces, references, exceptions that are thrown.
TEST(CodelSignaturesTest, InCppWithItsOwnTypes) {
  if (!HasCompilers()) GTEST_SKIP() << "there is no compiler";
  ExpectCompiles(
      "module m { enum side { left, right }; struct point { double x, y; }; typedef string<8> name; typedef double "
      "row[3];\n"
      " typedef sequence<point, 4> route; struct tree; typedef sequence<tree> trees; struct tree { trees under; long "
      "v[2]; };\n"
      " union target switch (side) { case left: point where; default: string<16> word; }; const unsigned long most = "
      "4; };\n"
      "interface light { function set(in double level, out boolean was); };\n"
      "component c { lang \"c++\"; uses light; native tool; exception late; exception slow { double by; };\n"
      " port in m::point seen; port out m::row shown; port multiple out m::route each;\n"
      " ids { boolean flag; m::side side; m::target target; m::name name; string text; sequence<double> many; m::trees "
      "trees; tool own;\n"
      "       struct part_s { octet a; enum k_e { one, two } k; } part; optional<m::point> maybe; m::route route; }; "
      "task t;\n"
      " activity a(in string word, in sequence<string<8>, 2> words, out double way) { task t; throw late, slow;\n"
      "  validate check(in flag, in side, local in word, local in words);\n"
      "  codel<start> a_start(in target, in name, in text, in many, in trees, in own, in part, in maybe, in route, out "
      "way) yield pause::start, go;\n"
      "  codel<go> a_go(out flag, out side, out target, out name, out text, inout many, inout trees, out own, out "
      "part, out maybe,\n"
      "    out route, in seen, out shown, out each, in set) yield ether;\n"
      "  codel<stop> a_stop() yield ether; }; };\n",
      "#include \"acc.h\"\n\n#include \"c_cxx_types.h\"\n\nstruct c::tool { int turns; };\n"
      "genom::event check(bool flag, m::side side, const std::string &word, const genom::bounded_sequence<char[8], 2> "
      "&words)\n{\n"
      "  if (flag && side == m::right && words.size() > 1) throw c::late();\n"
      "  if (word.empty()) { c::slow slow; slow.detail.by = 2; throw slow; }\n  return genom::ok;\n}\n"
      "genom::event a_start(const m::target &target, const m::name name, const std::string &text, const "
      "std::vector<double> &many,\n"
      "                     const m::trees &trees, const c::tool *own, const c::ids::part_s &part,\n"
      "                     const genom::optional<m::point> &maybe, const m::route &route, double &way)\n{\n"
      "  way = target._d == m::left ? target._u.where.x : many.size() + text.size() + trees.size();\n"
      "  if (name[0] == 'x' && own->turns > 2) return c::go;\n  for (const m::point &each : route) way += each.y;\n"
      "  return part.k == c::ids::part_s::two && maybe._present && route.size() < m::most ? c::go : "
      "c::pause::start;\n}\n"
      "genom::event a_go(bool &flag, m::side &side, m::target &target, m::name name, std::string &text, "
      "std::vector<double> &many,\n"
      "                  m::trees &trees, c::tool *&own, c::ids::part_s &part, genom::optional<m::point> &maybe, "
      "m::route &route,\n"
      "                  c::seen &seen, c::shown &shown, c::each &each, c::set &set)\n{\n"
      "  seen.read();\n  side = m::left;\n  target._u.where = seen.data();\n  shown.data()[1] = 2;\n  shown.write();\n"
      "  each.open(\"one\");\n  each.data(\"one\").push_back(seen.data());\n  each.write(\"one\");\n  set.call(0.5, "
      "flag);\n"
      "  trees.resize(2);\n  trees[1].under.resize(1);\n  name[0] = 'y';\n  text = \"z\";\n  many.push_back(1);\n"
      "  if (!own) own = new c::tool();\n  part.a = 3;\n  maybe._value.x = 1;\n  route.clear();\n  return "
      "c::ether;\n}\n"
      "genom::event a_stop(void) { return c::ether; }\n",
      {"g++ -std=c++11 -x c++", "g++ -std=c++20 -x c++"});
}

}  // namespace
}  // namespace runnel::genom
