#include <chrono>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "plugins/genom_description/description.h"
#include "tests/plugins/genom_description/verdict.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

TEST(GenomPreprocessorTest, MacrosAndConditions) {
  ExpectVerdicts({
      {kRight, "#define SIZE 4\nstruct s { long a[SIZE]; };"},
      {kRight, "#define PAIR(a, b) long a; double b\nstruct s { PAIR(x,\n y); };"},
      {kRight, "#define NAME(a, b) a ## _ ## b\ntypedef long NAME(my, type); typedef my_type other;"},
      {kRight, "#define TEXT(a) #a\nconst string a = TEXT(one \"two\");"},
      {kRight, "#define ALL(...) typedef long __VA_ARGS__\nALL(a, b);"},
      {kRight, "#define A B\n#define B A\ntypedef long A; typedef A c;"},
      {kRight, "#define F(x) x\n#define H(x) x\n#define G H(F)(long)\ntypedef G a;"},
      {kRight, "#define LONG \\\n  long\ntypedef LONG a;"},
      {kRight, "#define X\n#undef X\n#ifdef X\n#error here\n#endif\n"},
      {kRight, "#if defined(X) || !defined Y && 2 * 3 == 6 && (1 ? 1 : 0)\ntypedef long a;\n#endif\ntypedef a b;"},
      {kRight,
       "#if 0\n don't \"care\n#if 1\n#else\n#endif\n#elif 1\ntypedef long a;\n#else\n ???\n#endif\ntypedef a b;"},
      {kRight, "#ifndef __GENOM__\n#error no\n#endif\n"},
      {kWrong, "#if 1\n"},
      {kWrong, "#endif\n"},
      {kWrong, "#if 1 / 0\n#endif\n"},
      {kWrong, "#if (1\n#endif\n"},
      {kWrong, "#ifdef A B\n#endif\n"},
      {kWrong, "#ifdef\n#endif\n"},
      {kWrong, "#undef A B\n"},
      {kWrong, "#define\n"},
      {kWrong, "#pragma\n"},
      {kRight, "#\n#unknown A\n# 3 \"other.gen\"\n#if 1\n#else of what\n#endif of it\n"},
      {kRight, "#line 7 \"other.gen\"\n#line 8\ntypedef long a;"},
      {kWrong, "#line\n"},
      {kWrong, "#line other\n"},
      {kWrong, "#define F( 3\n"},
      {kWrong, "#if 1\n#else\n#else\n#endif\n"},
      {kRight, "#define M(x, r...) typedef x r\nM(long, a, b);"},
      {kRight, "#if 'a' == 97 && 0x10 == 16 && 010 == 8 && -1 < 0\ntypedef long a;\n#endif\ntypedef a b;"},
      {kRight, "// of two \\\n lines typedef\ntypedef long a;"},
      {kWrong, "#error on purpose\n"},
      {kRight, "typedef long a; /* with an end */"},
      {kWrong, "typedef long a; /* without an end"},
      {kWrong, "typedef long a; /*/"},
      {kRight, "typedef long a; // ends with the file"},
      {kRight, "#warning on purpose\n"},
      {kWrong, "#define F(x) x\ntypedef F(long, short) a;"},
      {kWrong, "#define F(x) x\ntypedef F(long a;"},
      {kWrong, "#include \"nowhere.gen\"\n"},
      {kRight, "const long a = __LINE__; const string b = __FILE__;"},
      {kRight,
       "#define FIELD(pre, name) double pre##name\nstruct s { FIELD(,x); FIELD(my_,y); }; typedef long doublex;"},
      {kRight, "#define THREE(a, b, c) a##b##c\ntypedef long THREE(,of,); typedef of THREE(,,other);"},
      {kRight, "#if defined(N) && 100 / N > 2 || 1 || 1 / 0\ntypedef long a;\n#endif\ntypedef a b;"},
      {kRight, "#if 0 ? 1 / 0 : 1 ? 1 : 1 % 0\ntypedef long a;\n#endif\ntypedef a b;"},
      {kWrong, "#if 1 && 1 / 0\n#endif\n"},
      {kWrong, "#if 1 ? 1 / 0 : 1\n#endif\n"},
      {kRight, "#if (-8 >> 1) == -4 && (-1 >> 99) == -1\ntypedef long a;\n#endif\ntypedef a b;"},
      {kRight, "#if 0\n\"all of /etc/*\"\n#endif\ntypedef long a;\n/* end */ typedef a b;"},
      {kRight, "#if 0\n \"a \\\" /*\"\n#endif\ntypedef long a;\n/* end */ typedef a b;"},
      {kRight, "#define s ms\ncomponent c { task t { period 5 s; }; };"},
  });
}

TEST(GenomPreprocessorTest, IncludesAndWhatTheyAreRelativeTo) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder.path() / name).parent_path());
    std::ofstream(folder.path() / name) << text;
  };
  write("main.gen", "#include \"own/a.idl\"\n#include <b.idl>\ntypedef a c; typedef b d;\n");
  write("own/a.idl", "#include \"base.idl\"\ntypedef base a;\n");
  write("own/base.idl", "typedef long base;\n");
  write("shared/b.idl", "typedef long b;\n");
  Diagnostics diagnostics;
  const auto description = genom::ReadDescription(
      {(folder.path() / "main.gen").string()}, {.include_folders = {(folder.path() / "shared").string()}}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  EXPECT_EQ(description->problems.files().size(), 4u);
}

TEST(GenomPreprocessorTest, AFileThatIncludesItselfEnds) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "self.gen").string();
  std::ofstream(file) << "#include \"self.gen\"\n#include \"self.gen\"\n";
  Diagnostics diagnostics;
  (void)genom::ReadDescription({file}, {}, diagnostics);
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("include each other without end"));
}

TEST(GenomPreprocessorTest, MacrosThatGrowEnd) {
  std::string text = "#define A0 long a;\n";
  for (int i = 1; i < 40; ++i) {
    const std::string last = "A" + std::to_string(i - 1);
    text += "#define A" + std::to_string(i) + " " + last + " " + last + "\n";
  }
  EXPECT_THAT(Wrongs(text + "struct s { A39 };"), HasSubstr("too many tokens"));
}

TEST(GenomPreprocessorTest, WordsThatDoubleEnd) {
  for (const char* twice : {"x##x", "T(#x)"}) {
    std::string use = "a";
    for (int i = 0; i < 40; ++i) use = "Q(" + use + ")";
    EXPECT_THAT(Wrongs(std::string("#define T(x) #x #x\n#define P(x) ") + twice +
                       "\n#define Q(x) P(x)\nconst string a = " + use + ";"),
                HasSubstr("too many tokens"));
  }
}

TEST(GenomPreprocessorTest, LongTextsManyTimesEnd) {
  std::string text = "#define D \"" + std::string(1 << 20, 'x') + "\"\nconst string a =";
  for (int i = 0; i < 3000; ++i) text += " D";
  EXPECT_THAT(Wrongs(text + ";"), HasSubstr("too many tokens"));
}

TEST(GenomPreprocessorTest, ManyUsesOfMacrosThatGiveNothingEnd) {
  std::string text = "#define A0\n";
  for (int i = 1; i < 6; ++i) {
    text += "#define A" + std::to_string(i);
    for (int j = 0; j < 10; ++j) text += " A" + std::to_string(i - 1);
    text += "\n";
  }
  for (int i = 0; i < 100'000; ++i) text += "A5\n";
  EXPECT_THAT(Wrongs(text), HasSubstr("too many tokens"));
}

TEST(GenomPreprocessorTest, ALongChainOfMacrosIsNoMoreThanItsLength) {
  std::string text = "#define A20000 long\n";
  for (int i = 0; i < 20'000; ++i) text += "#define A" + std::to_string(i) + " A" + std::to_string(i + 1) + "\n";
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(Wrongs(text + "typedef A0 a;"), "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(GenomPreprocessorTest, PackagesGiveFoldersAndMacros) {
  genom::PreprocessorOptions options;
  options.flags_of_package = [](const std::string& package) -> Result<std::vector<std::string>> {
    if (package != "known >= 2") return Error{.message = "no package '" + package + "'"};
    return std::vector<std::string>{"-DTYPE=long", "-I/nowhere"};
  };
  Diagnostics right;
  (void)genom::ReadDescriptionText("#pragma requires \"known >= 2\"\ntypedef TYPE a;\n", "a.gen", options, right);
  EXPECT_TRUE(right.ok()) << right.ToString();
  Diagnostics wrong;
  (void)genom::ReadDescriptionText("#pragma require other\n", "a.gen", options, wrong);
  EXPECT_THAT(wrong.ToString(), HasSubstr("a.gen:1:1: error: no package 'other'"));
}

}  // namespace
}  // namespace runnel::test
