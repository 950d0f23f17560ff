// Types of C++ stand for those of a description only if each member is where it is there.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>

#include "plugins/genom_description/description.h"
#include "plugins/genom_templates/template_run.h"
#include "tests/support/temporary_folder.h"

namespace runnel::genom {
namespace {

using testing::HasSubstr;

constexpr const char* kMasquerading =
    "module m { enum side { left, right }; struct pose { double x, y; float heading; side where; short marks[2]; }; "
    "};\n"
    "#pragma masquerade runnel m::pose \"Native native.h\"\n"
    "component c { port in m::pose p; task t; };\n";

// What the compiler says of the checks if the native type is this one.
std::string ComplaintsAbout(const std::string& native) {
  Diagnostics diagnostics;
  const auto description = ReadDescriptionText(kMasquerading, "c.gen", {}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  const auto output = RunTemplate(RUNNEL_GENOM_TEMPLATE_FOLDER "/runnel", DescriptionJson(*description), {});
  if (!output) return output.error().ToString();
  const test::TemporaryFolder folder;
  (void)WriteFiles(folder.path(), output->files, WhatIsThere::kIsMerged, diagnostics);
  std::ofstream(folder.path() / "native.h")
      << "#pragma once\n#include \"core/types/type_of.h\"\n#include <cstdint>\n"
      << native << "\ninline void Describe(runnel::TypeBuilder<Native>& type) { type.Name(\"Native\"); }\n";
  std::ofstream(folder.path() / "main.cpp") << "#include <native.h>\n#include \"c_types.h\"\nint main() {}\n";
  const std::string command = "cd '" + folder.path().string() +
                              "' && g++ -std=c++20 -fsyntax-only -Wall -Werror -I. -I" RUNNEL_TEST_ROOT
                              " main.cpp 2>&1";
  std::string text;
  std::array<char, 4096> buffer{};
  FILE* const pipe = popen(command.c_str(), "r");
  while (fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) text += buffer.data();
  pclose(pipe);
  return text;
}

TEST(MasqueradeTest, IsCheckedMemberByMember) {
  if (std::system("g++ --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no compiler";
  EXPECT_EQ(ComplaintsAbout("enum class Side : std::uint32_t { left, right };\n"
                            "struct Native { double x, y; float heading; Side where; std::int16_t marks[2]; };"),
            "");
  const std::string stands = "c.gen:1:46: 'Native' stands for 'm::pose', and ";
  EXPECT_THAT(
      ComplaintsAbout("struct Native { double x, z; float heading; std::uint32_t where; std::int16_t marks[2]; };"),
      HasSubstr(stands + "has no member 'y'"));
  const std::string others = ComplaintsAbout(
      "struct Native { double y, x; std::uint32_t heading, where; std::int16_t marks[2]; long more; };");
  EXPECT_THAT(others, HasSubstr(stands + "its member 'x' lies elsewhere"));
  EXPECT_THAT(others, HasSubstr(stands + "its member 'heading' is no float"));
  EXPECT_THAT(others, HasSubstr(stands + "has another size"));
}

}  // namespace
}  // namespace runnel::genom
