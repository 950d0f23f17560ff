#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/base/check.h"
#include "core/base/nearest_name.h"
#include "core/types/eigen_types.h"
#include "core/types/shared_vector_types.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"

namespace example {

struct Point {
  double x = 1.0;
  double y = 2.0;
  friend bool operator==(const Point&, const Point&) = default;
};
enum class Side : std::uint8_t { kLeft, kRight = 7 };
struct Path {
  std::string name;
  std::vector<Point> points;
  std::array<std::int16_t, 2> counts{};
  Side side = Side::kLeft;
  bool is_closed = false;
  runnel::Duration age{};
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::MatrixXd covariance;
  std::vector<Path> branches;
  friend bool operator==(const Path&, const Path&) = default;
};
struct Handle {
  std::unique_ptr<int> resource;
};
struct Impostor {};

void Describe(runnel::TypeBuilder<Point>& type) {
  type.Name("Point").Field("x", &Point::x, {.unit = "m"}).Field("y", &Point::y, {.unit = "m"});
}
void Describe(runnel::TypeBuilder<Side>& type) {
  type.Name("Side").Value("left", Side::kLeft).Value("right", Side::kRight);
}
void Describe(runnel::TypeBuilder<Path>& type) {
  type.Name("Path")
      .Field("name", &Path::name)
      .Field("points", &Path::points)
      .Field("counts", &Path::counts)
      .Field("side", &Path::side)
      .Field("is_closed", &Path::is_closed)
      .Field("age", &Path::age)
      .Field("offset", &Path::offset)
      .Field("covariance", &Path::covariance)
      .Field("branches", &Path::branches);
}
void Describe(runnel::TypeBuilder<Handle>& type) { type.Name("Handle"); }
void Describe(runnel::TypeBuilder<Impostor>& type) { type.Name("Point"); }

}  // namespace example

namespace runnel {
namespace {

using example::Path;
using example::Point;
using example::Side;
using testing::ElementsAre;
using testing::HasSubstr;

Path SomePath() {
  Path path;
  path.name = "a \"long\" way\\\n";
  path.points = {{0.1, -3}, {1e300, 5}};
  path.counts = {-4, 32767};
  path.side = Side::kRight;
  path.is_closed = true;
  path.age = std::chrono::milliseconds(20);
  path.offset << 1, 2, 3;
  path.covariance.resize(2, 3);
  path.covariance << 1, 2, 3, 4, 5, 6;
  path.branches.resize(1);
  path.branches[0].covariance.resize(2, 0);
  return path;
}

template <typename T>
std::string WhyNot(std::string_view text) {
  const auto read = FromText<T>(text);
  return read ? "it could be read" : read.error().message + " | " + read.error().hint;
}

TEST(TypeOf, IsOneObjectPerTypeThatCanBeFoundByName) {
  EXPECT_EQ(&TypeOf<Point>(), &TypeOf<Point>());
  EXPECT_EQ(FindType("Point"), &TypeOf<Point>());
  EXPECT_EQ(FindType("Nothing"), nullptr);
  EXPECT_THAT(RegisteredTypes(), testing::Contains(&TypeOf<Point>()));
}

TEST(TypeOf, RefusesASecondTypeOfTheSameNameAgainAndAgain) {
  ASSERT_EQ(TypeOf<Point>().name(), "Point");
  EXPECT_THROW((void)TypeOf<example::Impostor>(), ProgrammingError);
  EXPECT_THROW((void)TypeOf<example::Impostor>(), ProgrammingError);
  EXPECT_EQ(FindType("Point"), &TypeOf<Point>());
}

TEST(TypeOf, NamesListsAfterTheirElements) {
  EXPECT_EQ(TypeOf<std::vector<Point>>().name(), "Point[]");
  EXPECT_EQ((TypeOf<std::array<std::vector<float>, 3>>().name()), "float[][3]");
  EXPECT_EQ(TypeOf<Eigen::Vector3d>().name(), "vector double[3]");
  EXPECT_EQ((TypeOf<Eigen::Matrix<float, 2, Eigen::Dynamic>>().name()), "matrix float[2x]");
}

TEST(TypeOf, SaysWhatIsInside) {
  const TypeInfo& type = TypeOf<Point>();
  ASSERT_EQ(type.fields().size(), 2u);
  EXPECT_EQ(type.fields()[1].name, "y");
  EXPECT_EQ(type.fields()[1].unit, "m");
  EXPECT_EQ(type.fields()[1].type, &TypeOf<double>());
  Point point;
  *static_cast<double*>(type.FindField("y")->address(&point)) = 8;
  EXPECT_EQ(point.y, 8);
  EXPECT_TRUE(TypeOf<Path>().is_transparent());
  EXPECT_FALSE(TypeOf<example::Handle>().is_transparent());
}

TEST(TextFormat, ReadsBackWhatItWrote) {
  const Path path = SomePath();
  const auto read = FromText<Path>(TextOf(path));
  ASSERT_TRUE(read) << TextOf(path) << "\n" << read.error().ToString();
  EXPECT_EQ(*read, path) << TextOf(path);
}

TEST(TextFormat, IsWhatAPersonWouldWrite) {
  EXPECT_EQ(TextOf(0.1), "0.1");
  EXPECT_EQ(TextOf(true), "true");
  EXPECT_EQ(TextOf(Side::kRight), "right");
  EXPECT_EQ(TextOf(std::string("a, b")), "a, b");
  EXPECT_EQ(TextOf(Point{}), "{x: 1, y: 2}");
  EXPECT_EQ(TextOf(std::vector<std::string>{"a", "b c"}), "[\"a\", \"b c\"]");
  const Eigen::Matrix2d matrix{{1, 2}, {3, 4}};
  EXPECT_EQ(TextOf(matrix), "[[1, 2], [3, 4]]");
  EXPECT_EQ(TextOf(example::Handle{}), "?");
}

TEST(TextFormat, LeavesFieldsThatAreNotNamedAsTheyAre) {
  EXPECT_EQ(*FromText<Point>(" { y : -5 } "), (Point{1, -5}));
  EXPECT_EQ(*FromText<Point>("{}"), Point{});
}

TEST(TextFormat, KeepsEveryNumberExactly) {
  for (const double number :
       {0.1, 1.0 / 3, 5e-324, std::numeric_limits<double>::max(), -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(*FromText<double>(TextOf(number)), number);
  }
  EXPECT_NE(*FromText<double>("nan"), *FromText<double>("nan"));
  EXPECT_EQ(*FromText<std::int64_t>(TextOf(std::numeric_limits<std::int64_t>::min())),
            std::numeric_limits<std::int64_t>::min());
}

TEST(TextFormat, SaysWhatIsWrong) {
  EXPECT_THAT(WhyNot<double>("1,5"), HasSubstr("'1,5' is no number"));
  EXPECT_THAT(WhyNot<double>(""), HasSubstr("is no number"));
  EXPECT_THAT(WhyNot<std::int32_t>("1.5"), HasSubstr("no whole number"));
  EXPECT_THAT(WhyNot<std::uint8_t>("256"), HasSubstr("does not fit into uint8 | allowed is 0 .. 255"));
  EXPECT_THAT(WhyNot<bool>("yes"), HasSubstr("neither true nor false"));
  EXPECT_THAT(WhyNot<Side>("lfet"), HasSubstr("there is no Side 'lfet' | did you mean 'left'?"));
  EXPECT_THAT(WhyNot<Point>("{z: 1}"), HasSubstr("Point has no field 'z'"));
  EXPECT_THAT(WhyNot<Point>("{x 1}"), HasSubstr("expected ':' after 'x' before '1}'"));
  EXPECT_THAT(WhyNot<Point>("{x: 1"), HasSubstr("expected ',' or '}' at the end"));
  EXPECT_THAT(WhyNot<Point>("{x: 1} y"), HasSubstr("expected the end before 'y'"));
  EXPECT_THAT(WhyNot<std::vector<double>>("[1, , 2]"), HasSubstr("is no number"));
  EXPECT_EQ(FromText<std::vector<std::string>>("[a, \"b c\"]").value(), (std::vector<std::string>{"a", "b c"}));
  EXPECT_THAT(WhyNot<std::vector<std::string>>("[[a]]"), HasSubstr("quotation marks"));
  EXPECT_THAT(WhyNot<Point>("[1]"), HasSubstr("expected '{' before a Point, found '['"));
  EXPECT_THAT(WhyNot<Point>("{x: 1, x: 2}"), HasSubstr("'x' is given twice"));
  EXPECT_THAT(WhyNot<std::vector<Point>>("[{x: 1}, {y: a}]"), HasSubstr("[1].y: 'a' is no number"));
  EXPECT_THAT(WhyNot<Eigen::Vector3d>("[1, 2]"), HasSubstr("too few"));
  EXPECT_THAT(WhyNot<Eigen::Vector3d>("[1, 2, 3, 4]"), HasSubstr("too many"));
  EXPECT_THAT(WhyNot<Eigen::MatrixXd>("[[1, 2], [3]]"), HasSubstr("rows differ"));
  EXPECT_THAT(WhyNot<Eigen::Matrix2d>("[[1, 2]]"), HasSubstr("1 rows of 2"));
  EXPECT_THAT(WhyNot<example::Handle>("{}"), HasSubstr("no text format"));
}

TEST(TextFormat, OfDurationsHasAUnit) {
  EXPECT_EQ(TextOf(Duration(std::chrono::milliseconds(20))), "20ms");
  EXPECT_EQ(TextOf(Duration(1'500'000'000)), "1.5s");
  EXPECT_EQ(TextOf(Duration(-1)), "-1ns");
  EXPECT_EQ(TextOf(Duration::min()), "-9223372036.854775808s");
  EXPECT_EQ(*FromText<Duration>("0.5 min"), std::chrono::seconds(30));
  EXPECT_EQ(*FromText<Duration>("20us"), std::chrono::microseconds(20));
  EXPECT_THAT(WhyNot<Duration>("20"), HasSubstr("write a number and a unit"));
  EXPECT_THAT(WhyNot<Duration>("1e300s"), HasSubstr("no duration"));
}

// A list of itself, of any depth.
struct Nest {
  std::vector<Nest> nests;
};
void Describe(TypeBuilder<Nest>& type) { type.Name("test::Nest").Field("nests", &Nest::nests); }

TEST(TextFormat, RefusesWhatIsNestedTooDeep) {
  const auto text = [](int levels) {
    std::string opening, closing;
    for (int i = 1; i < levels; ++i) {
      opening += "{nests: [";
      closing += "]}";
    }
    return opening + "{nests: []}" + closing;
  };
  EXPECT_TRUE(FromText<Nest>(text(50)));
  const auto deep = FromText<Nest>(text(1'000'000));
  ASSERT_FALSE(deep);
  EXPECT_THAT(deep.error().message, testing::HasSubstr("nested deeper than 100 levels"));
}

// Described by one of its parts, of one byte; too large for a list of even one.
struct Huge {
  bool is_on = false;
  std::array<char, 1 << 29> more{};  // 512 MiB
};
void Describe(TypeBuilder<Huge>& type) { type.Name("test::Huge").Field("is_on", &Huge::is_on); }

TEST(TextFormat, MakesNoRoomForMoreThanItsLimit) {
  const auto list = FromText<std::vector<Huge>>("[{is_on: true}]");
  ASSERT_FALSE(list);
  EXPECT_THAT(list.error().message, testing::HasSubstr("more than 256 MiB"));
}

TEST(TextFormat, ShortensListsAndTextsForPeople) {
  const auto text = [](const auto& value, const TextLimits& limits) {
    return ToText(TypeOf<std::decay_t<decltype(value)>>(), &value, limits);
  };
  const std::vector<std::int32_t> numbers(640, 7);
  EXPECT_EQ(text(numbers, {.elements = 2}), "[7, 7, … 640 in all]");
  EXPECT_EQ(text(std::string(200, 'x'), {.text = 3}), "xxx… 200 bytes in all");
  EXPECT_EQ(text(std::vector<std::string>{"aö"}, {.text = 2}), "[\"a…\" 3 bytes in all]");
  const Path path = SomePath();
  EXPECT_EQ(text(path, {.elements = 1000, .text = 1000, .all = 100'000}), TextOf(path));
}

TEST(TextFormat, EndsAfterItsLimitHoweverLargeTheValueIs) {
  const std::vector<std::vector<double>> table(1000, std::vector<double>(1000, 0.125));
  EXPECT_LT(ToText(TypeOf<std::vector<std::vector<double>>>(), &table, {.all = 5'000}).size(), 5'300U);
  const std::vector<std::string> texts{"a\r\n\t\"\\"};
  EXPECT_EQ(*FromText<std::vector<std::string>>(TextOf(texts)), texts);
}

TEST(CopyValue, CopiesEveryPart) {
  const Path path = SomePath();
  Path copy;
  copy.branches.resize(7);
  ASSERT_TRUE(CopyValue(TypeOf<Path>(), &path, &copy));
  EXPECT_EQ(copy, path);
  const example::Handle handle;
  example::Handle other;
  EXPECT_THROW((void)CopyValue(TypeOf<example::Handle>(), &handle, &other), ProgrammingError);
}

TEST(TypeInfo, TellsWhichElementsMayBeCopiedAtOnce) {
  using RowMajor = Eigen::Matrix<float, 2, 3, Eigen::RowMajor>;
  const auto are_plain = [](const TypeInfo& type) { return type.elements().are_plain_numbers; };
  EXPECT_TRUE(are_plain(TypeOf<std::vector<std::uint8_t>>()));
  EXPECT_TRUE((are_plain(TypeOf<std::array<double, 3>>())));
  EXPECT_TRUE(are_plain(TypeOf<Eigen::Vector3d>()));
  EXPECT_TRUE(are_plain(TypeOf<Eigen::RowVectorXf>()));
  EXPECT_TRUE(are_plain(TypeOf<RowMajor>()));
  EXPECT_FALSE(are_plain(TypeOf<Eigen::Matrix2d>())) << "its memory has column after column";
  EXPECT_FALSE((are_plain(TypeOf<std::array<bool, 3>>()))) << "not every byte is a bool";
  EXPECT_FALSE(are_plain(TypeOf<std::vector<Side>>()));
  EXPECT_FALSE(are_plain(TypeOf<std::vector<Point>>()));
  EXPECT_FALSE(are_plain(TypeOf<std::optional<double>>()));

  RowMajor matrix;
  matrix << 1, 2, 3, 4, 5, 6;
  const auto& elements = TypeOf<RowMajor>().elements();
  const auto* const first = static_cast<const float*>(elements.element(&matrix, 0));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(elements.element(&matrix, i), first + i);
}

TEST(TypeInfo, OfAListWithMemoryOfOthersIsAsOfAnyList) {
  using List = SharedVector<float>;
  const TypeInfo& type = TypeOf<List>();
  EXPECT_EQ(type.name(), "shared float[]");
  const auto memory = std::make_shared<std::vector<float>>(std::vector<float>{1, 2, 3});
  List list;
  EXPECT_FALSE(ReferTo(type, &list, reinterpret_cast<const char*>(memory->data()) + 1, 2, memory)) << "not aligned";
  std::vector<float> own;
  EXPECT_FALSE(ReferTo(TypeOf<std::vector<float>>(), &own, memory->data(), 3, memory));
  ASSERT_TRUE(ReferTo(type, &list, memory->data(), 3, memory));
  EXPECT_EQ(std::as_const(list).data(), memory->data());
  EXPECT_EQ(ToText(type, &list), "[1, 2, 3]");
  EXPECT_TRUE(list.is_reference()) << "looking copies nothing";
  List copy;
  ASSERT_TRUE(CopyValue(type, &list, &copy));
  EXPECT_FALSE(copy.is_reference());
  EXPECT_EQ(copy, list);
  ASSERT_TRUE(CopyValue(type, &copy, &list)) << "what is written to by its description becomes its own";
  EXPECT_FALSE(list.is_reference());
  EXPECT_EQ(memory.use_count(), 1);
  EXPECT_EQ(FromText<List>("[4, 5]").value(), (List{4, 5}));
}

TEST(TypeInfo, MakesValues) {
  const auto point = TypeOf<Point>().Make();
  EXPECT_EQ(*static_cast<Point*>(point.get()), Point{});
}

struct Base {
  int of_base = 0;
};
template <typename T>
struct Kept : Base {
  T first = {};
  T k = {};
  T kept_ = {};
};
enum class Turn { kLeft, kSharpLeft, kU, kNot2 };
void Describe(TypeBuilder<Kept<std::array<double, 2>>>& type) {
  using Own = Kept<std::array<double, 2>>;
  type.Name("test::Kept").Fields<&Own::first, &Own::k, &Own::kept_>({.unit = "m"}).Fields<&Own::of_base>();
}
void Describe(TypeBuilder<Turn>& type) {
  type.Name("test::Turn").Values<Turn::kLeft, Turn::kSharpLeft, Turn::kU, Turn::kNot2>();
}

TEST(TypeBuilder, NamesMembersAndEnumeratorsByThemselves) {
  const TypeInfo& type = TypeOf<Kept<std::array<double, 2>>>();
  EXPECT_EQ(NamesOf(type.fields(), &FieldInfo::name), (std::vector<std::string>{"first", "k", "kept", "of_base"}));
  EXPECT_EQ(type.FindField("kept")->unit, "m");
  EXPECT_EQ(type.FindField("of_base")->unit, "");
  EXPECT_EQ(NamesOf(TypeOf<Turn>().enumerators(), &EnumeratorInfo::name),
            (std::vector<std::string>{"left", "sharp_left", "u", "not2"}));
}

}  // namespace
}  // namespace runnel
