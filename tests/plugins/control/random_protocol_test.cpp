#include <charconv>

#include "core/element/configurable.h"
#include "core/plugin/module_type_name.h"
#include "plugins/control/command.h"
#include "tests/plugins/control/control_fixture.h"
#include "tests/plugins/control/random_requests.h"

namespace runnel::test {

namespace {

// How many inputs: few in the tests of every day; the target fuzz_control asks for a million.
std::size_t InputCount(std::size_t usual) {
  const char* const asked = std::getenv("RUNNEL_RANDOM_INPUTS");
  return asked != nullptr ? std::strtoul(asked, nullptr, 10) : usual;
}

class Heard final : public Answer {
 public:
  void Write(std::string_view text) override { bytes += text.size(); }
  void WriteError(std::string_view text) override { errors += text; }
  std::size_t bytes = 0;
  std::string errors;
};

std::string StructureOf(Runtime& runtime) {
  const std::lock_guard lock(runtime.structure_mutex());
  std::string text;
  runtime.root().Visit([&](FrameworkElement& each) {
    text += each.path() + " " + FindModuleType(each) + " " + std::to_string(each.id());
    if (const auto* value = dynamic_cast<const Configurable*>(&each)) text += value->ToText();
    if (const auto* port = dynamic_cast<const Port*>(&each)) {
      for (const Connection& edge : port->outgoing()) {
        text += ">" + edge.to->path() + std::to_string(edge.options.queue);
      }
    }
    text += "\n";
  });
  return text;
}

}  // namespace

class RandomProtocol : public ControlTest {
 protected:
  // How the command ended; nothing if it would go on for ever, or waits for time to pass.
  std::optional<ControlCode> Carry(const std::string& request, Answer& answer, CommandService& commands,
                                   TaskGroup& tasks) {
    auto command = MakeCommand(request, commands, tasks);
    if (!command) {
      answer.WriteError(ErrorLine(command.error()));
      return ControlCode::kBadInput;
    }
    const bool is_change = request.starts_with("change");
    for (int i = 0; is_change || i < 3; ++i) {
      if (const auto code = command->Continue(answer)) return code;
      if (is_change) std::this_thread::yield();
    }
    return {};
  }
  // Back to two modules, lest the application grow without end.
  void Tidy() {
    for (const char* path : {"/c", "/g", "/app/app"}) (void)editor.Apply({DeleteElement{path}});
    if (StructureOf(runtime).size() < 4'000) return;
    (void)editor.Apply({DeleteElement{"/app"}});
    (void)editor.Apply({CreateGroup{"/app"}});
    (void)editor.Apply(
        {CreateModule{"/app/a", "test/counter"}, CreateModule{"/app/b", "test/sink"}, AssignToThread{"/app", "main"}});
  }
};

TEST_F(RandomProtocol, NeitherBreaksNorHalfChangesTheApplication) {
  CommandService commands({runtime, modules, editor, log, hooks});
  TaskGroup tasks(commands.worker());
  RandomRequests requests(1, RUNNEL_CORPUS);
  const std::size_t count = InputCount(20'000);
  std::size_t done = 0;
  std::size_t refused = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string request = requests.Next();
    const std::string before = StructureOf(runtime);
    Heard heard;
    const auto code = Carry(request, heard, commands, tasks);
    if (code == ControlCode::kBadInput) {
      ++refused;
      ASSERT_FALSE(heard.errors.empty()) << request;
      ASSERT_EQ(StructureOf(runtime), before) << request;
    }
    if (code == ControlCode::kDone) ++done;
    if (i % 50 == 0) Tidy();
  }
  EXPECT_GT(done, count / 50);
  EXPECT_GT(refused, count / 10);
  EXPECT_EQ(Ask("ls").code, 0);
}

TEST_F(RandomProtocol, IsReadFromAnyBytesInAnyPieces) {
  RandomRequests requests(2, RUNNEL_CORPUS);
  const std::size_t count = InputCount(100'000);
  std::size_t frames = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::string bytes = requests.NextBytes();
    if (requests.Below(2) == 0) bytes += requests.NextBytes();
    FrameReader reader(10'000);
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t piece = 1 + requests.Below(64);
      reader.Add(std::string_view(bytes).substr(at, piece));
      at += piece;
      for (;;) {
        const auto frame = reader.Take();
        if (!frame) at = bytes.size();
        if (!frame || !*frame) break;
        ++frames;
        ASSERT_LE((*frame)->payload.size(), 10'000U);
        const auto request = Request::Parse((*frame)->payload);
        if (!request) continue;
        const auto again = Request::Parse(request->ToText());
        ASSERT_TRUE(again) << request->ToText();
        ASSERT_EQ(again->ToText(), request->ToText());
      }
    }
  }
  EXPECT_GT(frames, count / 2);
}

TEST_F(RandomProtocol, OverTheSocketIsAnsweredOrHungUpOn) {
  RandomRequests requests(3, RUNNEL_CORPUS);
  const std::size_t count = InputCount(100'000) / 100;
  std::size_t answered = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int client = RawClient();
    std::string bytes;
    for (std::size_t left = 1 + requests.Below(5); left > 0; --left) bytes += requests.NextBytes();
    SendAll(client, bytes);
    shutdown(client, SHUT_WR);
    // Some do not wait for the answer; some requests go on for ever.
    if (requests.Below(2) == 0) {
      const std::string all = ReadAll(client, "end 1\n", 100);
      if (all.find("end 1\n") != std::string::npos) ++answered;
    }
    close(client);
    if (i % 20 == 0) Tidy();
  }
  EXPECT_GT(answered, count / 10);
  EXPECT_EQ(Ask("types").code, 0);
}

}  // namespace runnel::test
