#include "plugins/inspector/internal/viewer_message.h"

#include <random>

#include <gmock/gmock.h>

#include "tests/plugins/inspector/change_message.h"

namespace runnel::internal {

namespace {

using ::testing::HasSubstr;

TEST(ViewerMessage, IsReadMemberByMember) {
  const auto message = ParseViewerMessage(
      R"({"op":"change","request":7,"label":"l","changes":[{"change":"delete","path":"/a"},{"change":"tidy"}],"rate":2.5,"elements":3,"more":[1]})");
  ASSERT_TRUE(message) << message.error().ToString();
  EXPECT_EQ(message->op, "change");
  EXPECT_EQ(message->request, 7U);
  ASSERT_EQ(message->changes.size(), 1U);
  EXPECT_EQ(std::get<DeleteElement>(message->changes[0]).path, "/a");
  ASSERT_EQ(message->wrong_changes.size(), 1U);
  EXPECT_EQ(message->wrong_changes[0].change, 1U);
  EXPECT_EQ(message->rate, 2.5);
  EXPECT_EQ(message->elements, 3U);
  EXPECT_EQ(message->cycles, 1U);
  EXPECT_EQ(message->speed, std::nullopt);
}

TEST(ViewerMessage, WhatIsNoneIsRefused) {
  for (const char* text : {"",
                           "{",
                           "null",
                           "[]",
                           "7",
                           "\"op\"",
                           "{}",
                           R"({"op":7})",
                           R"({"op":""})",
                           R"({"op":"a"} x)",
                           R"({"op":"a","request":-1})",
                           R"({"op":"a","request":1.5})",
                           R"({"op":"a","request":1e300})",
                           R"({"op":"a","request":"1"})",
                           R"({"op":"a","changes":"b"})",
                           R"({"op":"a","rate":"fast"})",
                           R"({"op":"a","rate":-1})",
                           R"({"op":"a","path":["b"]})",
                           "{\"op\":\"a\x80\"}",
                           R"({"op":"a","rate":1e999})"}) {
    EXPECT_FALSE(ParseViewerMessage(text)) << text;
  }
}

TEST(ViewerMessage, SaysWhichMemberIsWrong) {
  const auto message = ParseViewerMessage(R"({"op":"watch","rate":"fast"})");
  ASSERT_FALSE(message);
  EXPECT_EQ(message.error().message, "'watch': \"rate\" must be a number, not below 0");
}

// What one reader or writer knows of a change, all do.
TEST(ViewerMessage, EachChangeSaysTheSameAsATextAndAsJson) {
  for (const ChangeForm& form : ChangeForms()) {
    const auto json = JsonPart::Parse(test::ChangeMessage(form.example).dump());
    ASSERT_TRUE(json) << form.name;
    const auto change = ParseChange(*json);
    ASSERT_TRUE(change) << form.name << ": " << change.error().ToString();
    EXPECT_EQ(ChangeText(*change), form.example);
    EXPECT_EQ(FormOf(*change), &form);
  }
}

TEST(ViewerMessage, WhatAChangeLacksIsSaidAndNotMadeUp) {
  const auto told = [](const char* text) {
    const auto json = JsonPart::Parse(text);
    const auto change = json ? ParseChange(*json) : json.error();
    return change ? "" : change.error().message;
  };
  EXPECT_EQ(told(R"({"change":"create_port","path":"/a","type":"int"})"), "'create_port': \"direction\" is missing");
  EXPECT_EQ(told(R"({"change":"take","topic":"/a"})"), "'take': \"port\" is missing");
  EXPECT_EQ(told(R"({"change":"connect","from":"/a","to":"/b","queue":3,"pull":true})"),
            "'connect': a connection that pulls cannot have a queue");
  EXPECT_EQ(told(R"({"change":"tag","path":"/a","tags":"safety hidden"})"), "");
}

TEST(ViewerMessage, IsNotReadIntoDepths) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string text = R"({"op":"a","x":)";
    for (int i = 0; i < 200'000; ++i) text += bracket;
    const auto message = ParseViewerMessage(text);
    ASSERT_FALSE(message);
    EXPECT_THAT(message.error().message, HasSubstr("nested deeper than 4 levels"));
  }
}

TEST(ViewerMessage, SurvivesWhateverComes) {
  std::mt19937 random(5);
  const std::string characters = R"({}[]",:0123456789.eE+-truefalsn \u"op""watch""path")";
  const std::string good = R"({"op":"change","changes":[{"change":"set","path":"/a","value":"3"}],"rate":2})";
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  int read = 0;
  for (int i = 0; i < 50'000; ++i) {
    std::string text = good;
    for (std::size_t changes = below(6); changes > 0; --changes) {
      text[below(text.size())] = below(10) == 0 ? static_cast<char>(below(256)) : characters[below(characters.size())];
    }
    if (below(4) == 0) text.resize(below(text.size()));
    if (ParseViewerMessage(text)) ++read;
  }
  EXPECT_GT(read, 1000);  // that it is not all refused at the first character
  EXPECT_LT(read, 49'000);
}

}  // namespace

}  // namespace runnel::internal
