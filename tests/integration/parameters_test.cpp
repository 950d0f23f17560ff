// Parameters and what follows from them, through the terminal: ports, groups, the configuration, outputs that set them.

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

class Parameters : public testing::Test {
 protected:
  Parameters() {
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    std::ofstream(file_) << R"(<application name="signals">
  <load plugin="flow"/> <load plugin="signal"/>
  <clock type="simulated" paused="true"/> <thread name="main" period="10ms"/>
  <group name="all" config="/signals">
    <parameter name="offset" to="one/offset two/offset"/>
    <module name="one" type="signal/linear"/>
    <module name="two" type="signal/linear"/>
  </group>
  <module name="mux" type="flow/mux"> <parameter name="inputs" value="3"/> </module>
  <connect from="mux/out" to="all/one/in all/two/in"/>
  <connect from="all/one/out" to="mux/in1"/> <connect from="all/two/out" to="mux/in3"/>
</application>
)";
    std::ofstream(entries_) << "<configuration>\n  <!-- tried out -->\n  <section name=\"signals\">\n"
                               "    <section name=\"one\"><value name=\"gain\">3</value></section>\n"
                               "  </section>\n</configuration>\n";
  }
  static std::string Text(const std::string& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  TemporaryFolder folder_;
  const std::string file_ = folder_ / "signals.xml";
  const std::string entries_ = folder_ / "entries.xml";
};

TEST_F(Parameters, AreChangedAndSavedInTheTerminal) {
  Program program("run " + file_ + " --config " + entries_);
  ASSERT_TRUE(program.WaitFor("paused"));
  EXPECT_THAT(Runnel("ls /all/one").text, HasSubstr("gain"));
  EXPECT_EQ(Runnel("set /all/offset 5").code, kDone);
  EXPECT_EQ(Runnel("set /all/one/gain 4").code, kDone);
  EXPECT_EQ(Runnel("save --config").code, kDone);
  const std::string saved = Text(entries_);
  EXPECT_THAT(saved, HasSubstr("<!-- tried out -->"));
  EXPECT_THAT(saved, HasSubstr("<value name=\"gain\">4</value>"));
  EXPECT_THAT(saved, HasSubstr("<value name=\"offset\">5</value>"));
  EXPECT_THAT(Runnel("save --config").text, HasSubstr("no value has changed"));
  // More ports, fewer, and back.
  EXPECT_EQ(Runnel("set /mux/inputs 5").code, kDone);
  EXPECT_EQ(Runnel("connect /all/one/out /mux/in5").code, kDone);
  EXPECT_THAT(Runnel("set /mux/inputs 2").text, HasSubstr("is not connected to /signals/mux/input/in3 any more"));
  EXPECT_EQ(Runnel("undo").code, kDone);
  EXPECT_THAT(Runnel("ls /mux -l").text, HasSubstr("in5"));
  // An output sets a parameter, also after the file has been loaded again.
  EXPECT_EQ(Runnel("connect /all/one/out /all/two/gain").code, kDone);
  EXPECT_EQ(Runnel("create parameter /all/gain one/gain").code, kDone);
  EXPECT_EQ(Runnel("save").code, kDone);
  EXPECT_THAT(Text(file_), HasSubstr(R"(<connect from="one/out" to="two/gain"/>)"));
  EXPECT_THAT(Text(file_), HasSubstr(R"(<parameter name="gain" to="one/gain"/>)"));
  EXPECT_THAT(Text(file_), HasSubstr(R"(name="inputs" value="5")"));
  const Ended checked = Runnel("check " + file_);
  EXPECT_EQ(checked.code, kDone) << checked.text;
}

}  // namespace
}  // namespace runnel::test
