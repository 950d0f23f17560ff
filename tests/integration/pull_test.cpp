// Connections that pull: from a file to the values, and from a command to the file.

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Pulling : public testing::Test {
 protected:
  Pulling() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }

  std::string Write(const std::string& tags) const {
    std::ofstream(file_) << "<application name=\"pulling\">\n"
                            "  <load plugin=\"faulty\"/>\n"
                            "  <clock type=\"simulated\" paused=\"true\"/>\n"
                            "  <thread name=\"main\" period=\"10ms\"/>\n"
                            "  <module name=\"counter\" type=\"faulty/provider\"/>\n"
                            "  <module name=\"reader\" type=\"faulty/reader\"/>\n  "
                         << tags << "\n</application>\n";
    return file_;
  }
  [[nodiscard]] std::string Saved() const {
    std::ifstream stream(file_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  TemporaryFolder folder_;
  const std::string file_ = folder_ / "pulling.xml";
};

TEST_F(Pulling, IsSaidInAFile) {
  Program program("run " + Write(R"(<connect from="counter/count" to="reader/in" pull="true"/>)"));
  ASSERT_TRUE(program.WaitFor("paused"));
  EXPECT_EQ(Runnel("step 3").code, kDone);
  EXPECT_THAT(Runnel("echo /reader/seen -n 1").text, HasSubstr("3"));
  EXPECT_THAT(Runnel("ls /counter -l").text, HasSubstr("to /pulling/reader/input/in (pulled)"));
}

TEST_F(Pulling, IsSaidByACommandAndSaved) {
  Program program("run " + Write(R"(<connect from="counter/count" to="reader/in"/>)"));
  ASSERT_TRUE(program.WaitFor("paused"));
  EXPECT_EQ(Runnel("step 3").code, kDone);
  EXPECT_THAT(Runnel("ls /reader/seen -l").text, HasSubstr("0 values"));
  EXPECT_EQ(Runnel("disconnect /counter/count /reader/in").code, kDone);
  EXPECT_EQ(Runnel("connect /counter/count /reader/in --pull").code, kDone);
  EXPECT_EQ(Runnel("step 2").code, kDone);
  EXPECT_THAT(Runnel("echo /reader/seen -n 1").text, HasSubstr("2"));
  EXPECT_EQ(Runnel("swap /reader faulty/reader").code, kDone);
  EXPECT_EQ(Runnel("save").code, kDone);
  EXPECT_THAT(Saved(), HasSubstr(R"(<connect from="counter/count" to="reader/in" pull="true"/>)"));
  EXPECT_EQ(Runnel("undo").code, kDone);
  EXPECT_EQ(Runnel("undo").code, kDone);
  EXPECT_EQ(Runnel("undo").code, kDone);
  EXPECT_EQ(Runnel("save").code, kDone);
  EXPECT_THAT(Saved(), Not(HasSubstr("pull=")));
  EXPECT_EQ(Runnel("redo").code, kDone);
  EXPECT_EQ(Runnel("redo").code, kDone);
  EXPECT_EQ(Runnel("save").code, kDone);
  EXPECT_THAT(Saved(), HasSubstr("pull=\"true\""));
}

TEST_F(Pulling, IsRefusedWhereNobodyProvides) {
  const Ended ended = Runnel("check " + Write(R"(<module name="other" type="faulty/reader"/>
  <connect from="reader/seen" to="other/in" pull="true"/>)"));
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("pulling.xml:8:18: error: /pulling/reader/output/seen: cannot "
                                    "be pulled: it has no provider"));
}

}  // namespace
}  // namespace runnel::test
