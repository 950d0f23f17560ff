#include <random>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "plugins/values/json_writer.h"
#include "tests/plugins/values/example_types.h"

namespace runnel::test {
namespace {

using example::Everything;
using example::Label;
using example::Point;
using example::Side;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

TEST(WrongJson, IsToldWithFieldAndCure) {
  EXPECT_EQ(WhyNot<Point>("{\"x\":1,\n \"z\":2}"), "Point has no field 'z' | did you mean 'x'?");
  EXPECT_EQ(WhyNot<Everything>(R"({"points":[{},{"x":"1"}]})"), R"(points[1].x: expected a number, found '"1"')");
  EXPECT_EQ(WhyNot<Everything>(R"({"lable":"a"})"), "Everything has no field 'lable' | did you mean 'label'?");
  EXPECT_EQ(WhyNot<Side>(R"("lfet")"), "there is no Side 'lfet' | did you mean 'left'?");
  EXPECT_EQ(WhyNot<Side>("5"), "there is no Side '5' | there is 'left', 'right'");
  EXPECT_EQ(WhyNot<Side>(R"("1")"), "there is no Side '1' | there is 'left', 'right'");
  EXPECT_EQ(WhyNot<Side>("[]"), "expected the name of a Side, found '['");
  EXPECT_EQ(WhyNot<Label>(R"("bad")"), "'bad' is no label | try good");
  EXPECT_EQ(WhyNot<Label>("7"), "expected a text in quotation marks, found '7'");
  EXPECT_EQ(WhyNot<bool>(R"("true")"), R"(expected true or false, found '"true"')");
  EXPECT_EQ(WhyNot<Point>(R"({"x":1,"x":2})"), "'x' is given twice");
  EXPECT_EQ(WhyNot<std::uint8_t>("256"), "'256' does not fit into uint8 | allowed are whole numbers 0 .. 255");
  EXPECT_THAT(WhyNot<int>("1.5"), StartsWith("'1.5' does not fit into int32"));
  EXPECT_THAT(WhyNot<std::int64_t>("9223372036854775808"), StartsWith("'9223372036854775808' does not fit into int64"));
  EXPECT_EQ(WhyNot<float>("1e60"), "'1e60' does not fit into float");
  EXPECT_EQ(WhyNot<std::vector<int>>("[1,null]"), "[1]: expected a whole number, found 'null'");
  EXPECT_EQ((WhyNot<std::array<std::int16_t, 2>>("[1]")), "1 elements are too few for a int16[2]");
  EXPECT_EQ((WhyNot<std::array<std::int16_t, 2>>("[1,2,3]")), "3 elements are too many for a int16[2]");
  EXPECT_EQ(WhyNot<Eigen::MatrixXd>("[[1,2],[3]]"), "the rows differ in length: 2 and 1");
  EXPECT_EQ(WhyNot<Eigen::MatrixXd>("[[1,2],[3,true]]"), "[1][1]: expected a number, found 'true'");
  EXPECT_THAT(WhyNot<Everything>(R"({"fixed":[[1]]})"), HasSubstr("fixed: 1 rows of 1 are no matrix"));
  EXPECT_EQ(WhyNot<Duration>(R"({"sec":1,"nsec":1000000000})"),
            "'nsec' is a number from 0 to 999999999, not 1000000000");
  EXPECT_EQ(WhyNot<Duration>(R"({"sec":9223372036,"nsec":854775808})"), "a duration cannot be that long");
  EXPECT_EQ(WhyNot<Duration>(R"({"sec":1,"sec":2})"), "'sec' is given twice");
  EXPECT_EQ(WhyNot<Time>(R"({"secs":1})"), "time has no field 'secs' | did you mean 'sec'?");
}

TEST(WrongJson, IsToldWithPlace) {
  EXPECT_EQ(WhyNot<Point>("{\"x\":1,\n \"y\":02}"),
            "2:7 syntax error while parsing object - unexpected number literal; expected '}'");
  EXPECT_THAT(WhyNot<Point>("{\"x\":"), StartsWith("1:6 syntax error while parsing value - "));
  EXPECT_EQ(WhyNot<double>(std::string_view("1\0 and more", 11)), "a JSON text contains a NUL character");
  EXPECT_THAT(WhyNot<double>(""), StartsWith("1:1 syntax error while parsing value - "));
  EXPECT_THAT(WhyNot<double>("1e5000"), StartsWith("1:6 number overflow parsing '1e5000'"));
  EXPECT_LT(WhyNot<double>("'" + std::string(100000, 'a')).size(), 300U);
}

TEST(WrongJson, IsWhatTheStandardDoesNotKnow) {
  for (const char* number : {"",    "+1",       "01",  "1.",  ".5",  "1e", "1e+", "0x10",  "1_000", "NaN",
                             "nan", "Infinity", "- 1", "--1", "1 2", "1,", "1a",  "1.5.2", "/**/1", "'1'"}) {
    EXPECT_THAT(WhyNot<double>(number), StartsWith("1:")) << number;
  }
  for (const char* text : {"\"", "\"a", "'a'", "\"\n\"", "\"\\x\"", "\"\\u12\"", "\"\\u12g4\"", "\"\\ud800\"",
                           "\"\\ud800\\u0041\"", "\"\\udc00\"", "\"\\", "\"\\u", "\"\x80\"", "\"\xc0\xaf\"",
                           "\"\xed\xa0\x80\"", "\"\xf4\x90\x80\x80\"", "\"\xe2\x82\"", "a"}) {
    EXPECT_THAT(WhyNot<std::string>(text), MatchesRegex("[12]:.*")) << text;
  }
  for (const char* object : {"{", "{\"x\"}", "{\"x\":}", "{\"x\":1,}", "{x:1}", "{\"x\":1 \"y\":2}", "{\"x\":1}}", "[",
                             "{\"x\":1]", "nul", "{,}"}) {
    EXPECT_THAT(WhyNot<Point>(object), StartsWith("1:")) << object;
  }
}

TEST(Json, KnowsAllEscapes) {
  EXPECT_EQ(Read<std::string>(R"("\"\\\/\b\f\n\r\t\u0041\u00e4\u20AC\ud83e\udd16")"),
            "\"\\/\b\f\n\r\tAä€\xf0\x9f\xa4\x96");
  const std::string with_zero("a\0b", 3);
  EXPECT_EQ(Read<std::string>("\"a\\u0000b\""), with_zero);
  EXPECT_EQ(JsonOf(with_zero), "\"a\\u0000b\"");
}

TEST(WrongJson, MayNotBeNestedWithoutEnd) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "{\"branches\":[";
  EXPECT_THAT(WhyNot<Everything>(deep), HasSubstr("nested deeper than 100 levels"));
  std::string rows = "{\"free\":[[";
  rows.append(1000000, '[');
  EXPECT_THAT(WhyNot<Everything>(rows), HasSubstr("nested deeper than 100 levels"));
}

// A long list must not be copied with each element, whatever it is made of.
TEST(Json, ReadsLongListsOfAllKinds) {
  constexpr std::size_t kCount = 300000;
  std::string json = "[0";
  for (std::size_t i = 1; i < kCount; ++i) json += ",0";
  json += "]";
  EXPECT_EQ(Read<Eigen::VectorXd>(json).size(), static_cast<Eigen::Index>(kCount));
  EXPECT_EQ(Read<std::vector<float>>(json).size(), kCount);
  EXPECT_EQ(Read<Eigen::MatrixXd>("[" + json + "]").cols(), static_cast<Eigen::Index>(kCount));
}

// Whatever comes, the reader says yes or no; where it says yes, what it read is JSON, and writing
// and reading that again makes no difference.
TEST(WrongJson, DoesNoHarm) {
  Everything value;
  value.text = "a\"\\€";
  value.points.resize(2);
  value.words = {{"b"}, {}};
  value.free = Eigen::MatrixXd::Ones(2, 2);
  value.branches.resize(1);
  const std::string whole = JsonOf(value);
  std::mt19937 random(5);
  constexpr std::string_view kPieces[] = {
      "{", "}",    "[",    "]",    ",",       ":", "\"", "\\",    "0",    "-",      "e",
      ".", "null", "true", "\xff", "\\ud83e", " ", "\n", "1e999", "[[[[", "\"x\":", "{\"branches\":["};
  int accepted = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string json = whole;
    for (auto change = 1 + random() % 3; change > 0; --change) {
      const std::size_t at = random() % json.size();
      switch (random() % 4) {
        case 0:
          json.erase(at, 1 + random() % 8);
          break;
        case 1:
          json.insert(at, kPieces[random() % std::size(kPieces)]);
          break;
        case 2:
          json[at] = static_cast<char>(random());
          break;
        default:
          json.resize(at + 1);
      }
      if (json.empty()) json = " ";
    }
    // In memory of its own, so that a look beyond the end is a look beyond an allocation.
    const std::vector<char> exact(json.begin(), json.end());
    Everything read;
    const auto done = SetFromJson(TypeOf<Everything>(), {exact.data(), exact.size()}, &read);
    if (!done) {
      ASSERT_FALSE(done.error().message.empty());
      continue;
    }
    ++accepted;
    const std::string again = JsonOf(read);
    ASSERT_EQ(JsonOf(Read<Everything>(again)), again) << json;
  }
  EXPECT_GT(accepted, 500);
  EXPECT_LT(accepted, 50000);
}

}  // namespace
}  // namespace runnel::test
