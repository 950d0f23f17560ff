#include "plugins/values/json_reader.h"

#include <limits>

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

using ::testing::IsEmpty;

TEST(JsonPart, KnowsWhatItIs) {
  const auto list = JsonPart::Parse(R"( [7, -1.5, "a\nb", null, {"a":1}, [2], 1e999, 1.0] )");
  ASSERT_TRUE(list);
  EXPECT_TRUE(list->is_list());
  const auto items = list->items();
  ASSERT_EQ(items.size(), 8U);
  EXPECT_EQ(items[0].count(), 7U);
  EXPECT_EQ(items[0].number(), 7.0);
  EXPECT_EQ(items[0].text(), std::nullopt);
  EXPECT_EQ(items[1].number(), -1.5);
  EXPECT_EQ(items[1].count(), std::nullopt);
  EXPECT_EQ(items[2].text(), "a\nb");
  EXPECT_EQ(items[2].number(), std::nullopt);
  EXPECT_TRUE(items[3].is_null());
  EXPECT_EQ(items[3].boolean(), std::nullopt);
  EXPECT_EQ(JsonPart::Parse("true")->boolean(), true);
  EXPECT_EQ(JsonPart::Parse("false")->boolean(), false);
  ASSERT_TRUE(items[4].is_object());
  EXPECT_THAT(items[4].items(), IsEmpty());
  const auto members = items[4].members();
  ASSERT_EQ(members.size(), 1U);
  EXPECT_EQ(members[0].first, "a");
  EXPECT_EQ(members[0].second.count(), 1U);
  EXPECT_THAT(items[5].members(), IsEmpty());
  EXPECT_EQ(items[6].number(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(items[7].count(), std::nullopt);
}

TEST(JsonPart, IsCheckedAsAWhole) {
  for (const char* text :
       {"", "[", "[1,]", "{\"a\"}", "{\"a\":1,}", "1 2", "nul", "\"\x80\"", "[\"\\x\"]", "{\"a\":01}"}) {
    EXPECT_FALSE(JsonPart::Parse(text)) << text;
  }
}

TEST(JsonPart, IsNotReadIntoDepths) {
  EXPECT_TRUE(JsonPart::Parse("[[1]]", 2));
  EXPECT_FALSE(JsonPart::Parse("[[[]]]", 2));
  EXPECT_EQ(JsonPart::Parse(std::string(1'000'000, '[')).error().message, "it is nested deeper than 100 levels");
}

TEST(JsonMembers, RememberTheFirstThatIsWrong) {
  const auto object = JsonPart::Parse(R"({"name":"a","rate":-1,"count":5,"none":null,"more":[]})");
  ASSERT_TRUE(object);
  JsonMembers members(*object);
  EXPECT_EQ(members.NeedText("name"), "a");
  EXPECT_EQ(members.Text("none"), std::nullopt);
  EXPECT_EQ(members.Text("nothing"), std::nullopt);
  EXPECT_EQ(members.Count("count", 5), 5U);
  EXPECT_THAT(members.NeedList("more"), IsEmpty());
  EXPECT_EQ(members.error(), std::nullopt);
  EXPECT_EQ(members.Number("rate"), std::nullopt);
  EXPECT_EQ(members.NeedText("count"), "");
  ASSERT_TRUE(members.error());
  EXPECT_EQ(members.error()->message, "\"rate\" must be a number, not below 0");
}

TEST(JsonMembers, RefuseWhatNobodyHasAskedFor) {
  const auto object = JsonPart::Parse(R"({"path":"a","pahts":"b"})");
  ASSERT_TRUE(object);
  JsonMembers members(*object);
  (void)members.Text("path");
  (void)members.Text("paths");
  members.RefuseOthers();
  ASSERT_TRUE(members.error());
  EXPECT_EQ(members.error()->message, "has no \"pahts\"");
  EXPECT_EQ(members.error()->hint, "did you mean 'paths'?");
}

}  // namespace
}  // namespace runnel::test
