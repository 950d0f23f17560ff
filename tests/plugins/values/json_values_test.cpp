#include "plugins/values/json_values.h"

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/types/text_format.h"
#include "tests/plugins/values/example_types.h"

namespace runnel::test {
namespace {

using example::Everything;
using example::Label;
using example::Point;
using example::Side;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Any bits at all: numbers of all sizes, denormal ones, infinities; and sometimes NaN.
class RandomValues {
 public:
  explicit RandomValues(unsigned seed) : random_(seed) {}

  template <typename N>
  N Number() {
    if constexpr (sizeof(N) == 8) {
      return std::bit_cast<N>(random_());
    } else if constexpr (sizeof(N) == 4) {
      return std::bit_cast<N>(static_cast<std::uint32_t>(random_()));
    } else {
      return static_cast<N>(random_());
    }
  }
  std::size_t Below(std::size_t end) { return random_() % end; }

  std::string Text() {
    static const std::vector<std::string> kPieces = {
        "a", "\"", "\\",      "/", "\n", "\r\t", std::string(1, '\0'), "\x1f", "\x7f", "ä", "€", "\xf0\x9f\xa4\x96",
        " ", "{[", "\xc2\x80"};
    std::string text;
    for (std::size_t i = Below(8); i > 0; --i) text += kPieces[Below(kPieces.size())];
    return text;
  }

  Everything Value(int depth) {
    Everything value;
    value.is_closed = Below(2) == 0;
    value.i8 = Number<std::int8_t>();
    value.i16 = Number<std::int16_t>();
    value.i32 = Number<std::int32_t>();
    value.i64 = Number<std::int64_t>();
    value.u8 = Number<std::uint8_t>();
    value.u16 = Number<std::uint16_t>();
    value.u32 = Number<std::uint32_t>();
    value.u64 = Number<std::uint64_t>();
    value.small = Number<float>();
    value.large = Number<double>();
    value.text = Text();
    value.age = Duration(Number<std::int64_t>());
    value.timestamp = Time(Duration(Number<std::int64_t>()));
    value.side = Below(2) == 0 ? Side::kLeft : Side::kRight;
    value.label = {Text()};
    value.points.resize(Below(4));
    for (Point& point : value.points) point = {Number<double>(), Number<double>()};
    value.words.resize(Below(3));
    for (auto& words : value.words) words.assign(Below(3), Text());
    value.counts = {Number<std::int16_t>(), Number<std::int16_t>()};
    value.offset << Number<double>(), 0.1, -0.0;
    value.state = Eigen::VectorXd::Random(static_cast<Eigen::Index>(Below(9)));
    value.fixed.setRandom();
    value.free = Eigen::MatrixXd::Random(static_cast<Eigen::Index>(1 + Below(3)), static_cast<Eigen::Index>(Below(4)));
    if (depth > 0) value.branches.push_back(Value(depth - 1));
    return value;
  }

 private:
  std::mt19937_64 random_;
};

std::string WithoutSignsOfNan(std::string text) {
  for (auto at = text.find("-nan"); at != std::string::npos; at = text.find("-nan")) {
    text.erase(at, 1);
  }
  return text;
}

TEST(JsonValues, ReadBackAsTheyWere) {
  RandomValues values(1);
  for (int i = 0; i < 2000; ++i) {
    const Everything value = values.Value(2);
    const std::string json = JsonOf(value);
    const auto read = Read<Everything>(json);
    // The text format keeps every bit, but it has a sign for NaN, which JSON has not.
    ASSERT_EQ(WithoutSignsOfNan(TextOf(read)), WithoutSignsOfNan(TextOf(value))) << json;
    ASSERT_EQ(JsonOf(read), json);
    ASSERT_TRUE(nlohmann::json::accept(json.find("1e999") == std::string::npos ? json : "0")) << json;
  }
}

TEST(JsonValues, LookAsViewersWantThem) {
  EXPECT_EQ(JsonOf(Point{0.1, -3}), R"({"x":0.1,"y":-3})");
  EXPECT_EQ(JsonOf(Side::kRight), R"("right")");
  EXPECT_EQ(JsonOf(static_cast<Side>(3)), "3");
  EXPECT_EQ(JsonOf(true), "true");
  EXPECT_EQ(JsonOf(std::vector<Point>(2)), R"([{"x":1,"y":2},{"x":1,"y":2}])");
  EXPECT_EQ(JsonOf(Duration(1'500'000'000)), R"({"sec":1,"nsec":500000000})");
  EXPECT_EQ(JsonOf(Duration(-1)), R"({"sec":-1,"nsec":999999999})");
  EXPECT_EQ(JsonOf(Time(Duration(7))), R"({"sec":0,"nsec":7})");
  Eigen::MatrixXd matrix(2, 3);
  matrix << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(JsonOf(matrix), "[[1,2,3],[4,5,6]]");
  EXPECT_EQ(JsonOf(Eigen::Vector3d(1, 2, 3)), "[1,2,3]");
  EXPECT_EQ(JsonOf(Label{"a\nb"}), R"("a\nb")");
}

TEST(JsonValues, KeepNumbersExactly) {
  EXPECT_EQ(JsonOf(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(Read<std::uint64_t>("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(Read<std::int64_t>("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(JsonOf(0.1F), "0.1");
  EXPECT_EQ(JsonOf(0.1), "0.1");
  EXPECT_EQ(Read<double>("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(std::signbit(Read<double>("-0")));
  EXPECT_EQ(Read<int>("3.0"), 3);
  EXPECT_EQ(Read<int>("-12e2"), -1200);
}

TEST(JsonValues, HaveNoNumberAndInfinityToo) {
  EXPECT_EQ(JsonOf(std::vector<double>{std::nan(""), kInfinity, -kInfinity}), "[null,1e999,-1e999]");
  EXPECT_EQ(JsonOf(std::vector<float>{NAN, INFINITY}), "[null,1e999]");
  EXPECT_EQ(JsonOf(std::vector<double>{1, -kInfinity}, {.has_infinity = false}), "[1,null]");
  const auto read = Read<std::vector<double>>("[null,1e999,-1e999,1e-999,0.0001e400,0e999]");
  EXPECT_TRUE(std::isnan(read[0]));
  EXPECT_EQ(read[1], kInfinity);
  EXPECT_EQ(read[2], -kInfinity);
  EXPECT_EQ(read[3], 0.0);
  EXPECT_EQ(read[4], kInfinity);
  EXPECT_EQ(read[5], 0.0);
  EXPECT_EQ(Read<float>("-1e999"), -std::numeric_limits<float>::infinity());
  EXPECT_EQ(Read<float>("1e-60"), 0.0F);
  EXPECT_EQ(Read<double>("1e4932"), kInfinity);
  EXPECT_EQ(Read<double>("1e-99999999999999999999"), 0.0);
}

TEST(JsonValues, AreReadInAnyOrderAndInPart) {
  const auto point = Read<Point>(" { \"y\" : 5 } ");
  EXPECT_EQ(point, (Point{1.0, 5}));
  EXPECT_EQ(Read<Point>("{}"), Point{});
  EXPECT_EQ(Read<Duration>(R"({"nsec":5})"), Duration(5));
  EXPECT_EQ(Read<Duration>(R"({"sec":-9223372037,"nsec":145224192})"), Duration::min());
}

TEST(JsonValues, BeginListsAnew) {
  std::vector<Point> points = {{7, 7}, {8, 8}, {9, 9}};
  ASSERT_TRUE(SetFromJson(TypeOf<std::vector<Point>>(), R"([{"x":5},{}])", &points));
  EXPECT_EQ(points, (std::vector<Point>{{5, 2}, {1, 2}}));
}

TEST(JsonValues, AreCutWhereAViewerWantsLess) {
  const std::vector<int> numbers = {1, 2, 3, 4};
  std::string json = "before ";
  EXPECT_FALSE(AppendJson(TypeOf<std::vector<int>>(), &numbers, json, {.elements = 2}));
  EXPECT_EQ(json, "before [1,2]");
  EXPECT_TRUE(AppendJson(TypeOf<std::vector<int>>(), &numbers, json, {.elements = 4}));
  const std::string text = "häßlich";
  EXPECT_EQ(JsonOf(text, {.characters = 2}), R"("h…")");
  EXPECT_EQ(JsonOf(text, {.characters = 3}), R"("hä…")");
  EXPECT_EQ(JsonOf(text, {.characters = 9}), R"("häßlich")");
  EXPECT_EQ(JsonOf(Eigen::MatrixXd::Zero(3, 3).eval(), {.elements = 2}), "[[0,0],[0,0]]");
}

TEST(JsonValues, StayJsonWhenTheWholeIsCut) {
  RandomValues values(3);
  for (int i = 0; i < 200; ++i) {
    Everything value = values.Value(3);
    // The other reader does not take infinities.
    for (Everything* at = &value;; at = &at->branches[0]) {
      at->large = at->small = 0;
      at->offset.setZero();
      at->points.assign(at->points.size(), Point{});
      if (at->branches.empty()) break;
    }
    const std::size_t most = values.Below(3000);
    const std::string json = JsonOf(value, {.bytes = most});
    ASSERT_TRUE(nlohmann::json::accept(json)) << json;
    ASSERT_LT(json.size(), most + 1000);  // all fields of one structure, and the ends of the others
  }
  EXPECT_EQ(JsonOf(std::string(1000, 'a'), {.bytes = 5}), R"("aaaaa…")");
}

TEST(JsonSchema, SaysWhatIsInside) {
  const auto schema = nlohmann::json::parse(JsonSchemaOf(TypeOf<Everything>()));
  EXPECT_EQ(schema["type"], "object");
  EXPECT_EQ(schema["title"], "Everything");
  EXPECT_EQ(schema["required"].size(), TypeOf<Everything>().fields().size());
  const auto& properties = schema["properties"];
  const auto expect = [&](const char* field, const char* wanted) {
    EXPECT_EQ(properties[field], nlohmann::json::parse(wanted)) << field;
  };
  expect("is_closed", R"({"type":"boolean"})");
  expect("i8", R"({"type":"integer","minimum":-128,"maximum":127})");
  expect("u64", R"({"type":"integer","minimum":0})");
  expect("large", R"({"type":"number","nullable":true})");
  expect("side", R"({"type":"string","enum":["left","right"]})");
  expect("label", R"({"type":"string"})");
  expect("counts", R"({"type":"array","minItems":2,"maxItems":2,
                       "items":{"type":"integer","minimum":-32768,"maximum":32767}})");
  expect("free", R"({"type":"array","items":{"type":"array",
                     "items":{"type":"number","nullable":true}}})");
  expect("points", R"({"type":"array","items":{"type":"object","title":"Point",
      "properties":{"x":{"description":"to the east [m]","type":"number","nullable":true},
                    "y":{"description":"[m]","type":"number","nullable":true}},
      "required":["x","y"]}})");
  expect("age", R"({"type":"object","title":"duration","properties":{"sec":{"type":"integer"},
      "nsec":{"type":"integer","minimum":0,"maximum":999999999}},"required":["sec","nsec"]})");
  expect("branches", R"({"type":"array","items":{"type":"object","title":"Everything","properties":{}}})");
}

}  // namespace
}  // namespace runnel::test
