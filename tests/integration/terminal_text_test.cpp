// What others have written is shown by the terminal and not obeyed: values, names of files, as a person sees them.

#include <cstdlib>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "plugins/mcap/mcap_writer.h"
#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// As a person's terminal, of which what programs write is kept.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    EXPECT_EQ(grantpt(master_), 0);
    EXPECT_EQ(unlockpt(master_), 0);
    const char* const name = ptsname(master_);
    name_ = name != nullptr ? name : "";
    kept_open_ = open(name_.c_str(), O_RDWR | O_NOCTTY);
  }
  ~Terminal() {
    close(kept_open_);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// What the program, run from its start to its end, writes there.
  [[nodiscard]] std::string Shows(const std::string& arguments) const {
    EXPECT_EQ(Runnel(arguments + " >" + name_ + " 2>" + name_ + " <" + name_).text, "");
    std::string text;
    char part[4096];
    for (ssize_t count = 0; (count = read(master_, part, sizeof part)) > 0;)
      text.append(part, static_cast<std::size_t>(count));
    return text;
  }

 private:
  const int master_;
  std::string name_;
  int kept_open_ = -1;
};

class TerminalText : public testing::Test {
 protected:
  TerminalText() {
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    std::ofstream(file_) << R"(<application name="texts">
  <load plugin="signal"/>
  <clock type="simulated" paused="true"/> <thread name="main" period="10ms"/>
  <module name="one" type="signal/linear"/>
  <group name="all"> <port name="said" type="string" direction="output"/> <port name="heard" type="string" direction="input"/> </group>
  <connect from="one/out" to="one/in" late="true"/>
  <connect from="all/said" to="all/heard"/>
</application>
)";
  }
  ~TerminalText() override { unsetenv("XDG_RUNTIME_DIR"); }

  const TemporaryFolder folder_;
  const std::string file_ = folder_ / "texts.xml";
  const Terminal terminal_;
};

// Red, a title for the window, a bell, the same by one octet, and a byte of no character.
const std::string kEvil =
    "\x1b[31mred \x1b]0;title\x07 \xc2\x9b"
    "31m \xff";
const std::string kShown = R"(\x1b[31mred \x1b]0;title\x07 \xc2\x9b31m \xff)";

TEST_F(TerminalText, OfValuesIsNotObeyed) {
  Program program("run " + file_);
  ASSERT_TRUE(program.WaitFor("paused"));
  ASSERT_EQ(Runnel("publish /all/said '" + kEvil + " STOP'").code, kDone);
  // Only what the program paints itself: \x1b is ESC where it stands in a string, and four characters in a raw one.
  const std::string painted = kShown + " \x1b[1;31mSTOP\x1b[0m";
  for (const std::string command : {"get /all/said", "echo /all/said -n 1", "ls /all"}) {
    EXPECT_THAT(terminal_.Shows(command), HasSubstr(painted)) << command;
    EXPECT_THAT(Runnel(command).text, HasSubstr(kShown + " STOP")) << command;
  }
}

TEST_F(TerminalText, OfFilesThatAreRecordedIsNotObeyed) {
  Program program("run " + file_);
  ASSERT_TRUE(program.WaitFor("paused"));
  ASSERT_EQ(Runnel("publish /all/said one").code, kDone);
  const std::string to = folder_ / "\x1b[31mred.mcap", record = "record -n 1 /all/said -o '" + to + "'";
  const auto is_shown = AllOf(HasSubstr(R"(\x1b[31mred.mcap)"), Not(HasSubstr("\x1b[31m")));
  EXPECT_THAT(terminal_.Shows(record), is_shown);
  EXPECT_THAT(terminal_.Shows(record), AllOf(HasSubstr("File exists"), is_shown));
  EXPECT_THAT(Runnel(record).text, is_shown);
}

TEST_F(TerminalText, OfRecordingsOfOthersIsNotObeyed) {
  const std::string file = folder_ / "evil.mcap";
  {
    auto writer = McapWriter::Create(file, {});
    ASSERT_TRUE(writer);
    const auto schema = (*writer)->AddSchema(kEvil, "jsonschema", "{}");
    ASSERT_TRUE(schema);
    const auto channel = (*writer)->AddChannel(*schema, "/" + kEvil, "json", {});
    ASSERT_TRUE(channel);
    ASSERT_TRUE((*writer)->AddMessage({*channel, 1, 10, 10, "{}"}));
    ASSERT_TRUE((*writer)->AddMetadata({"runnel", {{kEvil, kEvil}}}));
    ASSERT_TRUE((*writer)->Finish());
  }
  EXPECT_THAT(terminal_.Shows("info " + file), AllOf(HasSubstr("/" + kShown), Not(HasSubstr("\x1b[31m"))));
}

}  // namespace
}  // namespace runnel::test
