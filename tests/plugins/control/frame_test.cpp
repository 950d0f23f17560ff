#include <gmock/gmock.h>

#include "plugins/control/protocol.h"

namespace runnel::test {

using ::testing::HasSubstr;

TEST(Frame, ComesBackByteByByteAsItWasSent) {
  const std::string payload("two\nlines \0 and more", 20);
  const std::string bytes = FrameBytes("out", payload) + FrameBytes("end", "");
  FrameReader reader(100);
  std::vector<Frame> frames;
  for (const char byte : bytes) {
    reader.Add({&byte, 1});
    auto frame = reader.Take();
    ASSERT_TRUE(frame);
    if (*frame) frames.push_back(**frame);
  }
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].kind, "out");
  EXPECT_EQ(frames[0].payload, payload);
  EXPECT_EQ(frames[1].payload, "");
}

TEST(Frame, ManyComeAtOnce) {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += FrameBytes("out", std::to_string(i));
  FrameReader reader(10);
  reader.Add(bytes);
  for (int i = 0; i < 1000; ++i) {
    const auto frame = reader.Take();
    ASSERT_TRUE(frame && frame->has_value());
    EXPECT_EQ((*frame)->payload, std::to_string(i));
  }
  EXPECT_FALSE(reader.Take()->has_value());
}

TEST(Frame, IsRefusedBeforeItHasComeIfItIsTooLong) {
  FrameReader reader(10);
  reader.Add("request 11\n");
  EXPECT_THAT(reader.Take().error().message, HasSubstr("too long"));
}

TEST(Frame, IsRefusedIfItIsNone) {
  for (const char* bytes : {"x\n", "\n", "Request 1\n", "request -1\n", "request 1x\n", "request 1 \n", " 1\n",
                            "request 99999999999999999999999\n", "request 1\nabc", "averyveryverylongkind 1\n",
                            "no end of line in the first forty bytes"}) {
    FrameReader reader(100);
    reader.Add(bytes);
    EXPECT_FALSE(reader.Take()) << bytes;
  }
}

TEST(Request, ComesBackAsItWasWritten) {
  const Request request{.command = "echo",
                        .arguments = {"/a b/c", "x=y", ""},
                        .options = {{"count", "3"}, {"file", "a \"b\".txt"}},
                        .body = "line\n\nline"};
  const auto read = Request::Parse(request.ToText());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->command, request.command);
  EXPECT_EQ(read->arguments, request.arguments);
  EXPECT_EQ(read->options, request.options);
  EXPECT_EQ(read->body, request.body);
}

TEST(Request, IsRefusedIfItIsNotOneLineOfArguments) {
  for (const char* text : {"", "\nbody", "a;b", "count=3", "ls \"", "ls a=1 a=2"}) {
    EXPECT_FALSE(Request::Parse(text)) << text;
  }
}

}  // namespace runnel::test
