#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/module.h"
#include "plugins/parameters/parameter.h"
#include "plugins/parameters/parameter_base.h"

namespace runnel {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string In(std::string_view unit, std::string_view text) {
  const auto number = NumberInUnit(text, unit);
  return number ? *number : number.error().ToString();
}

TEST(NumberInUnit, IsTheSameToTheLastBit) {
  EXPECT_EQ(In("m", "15 cm"), "0.15");
  EXPECT_EQ(In("m", "35cm"), "0.35");
  EXPECT_EQ(In("m", "+2 km"), "2000");
  EXPECT_EQ(In("m", "-7 µm"), "-0.000007");
  EXPECT_EQ(In("m/s", "36 km/h"), "10");
  EXPECT_EQ(In("m/s", "0.5 m/s"), "0.5");
  EXPECT_EQ(In("m/s^2", "981 cm/s²"), "9.81");
  EXPECT_EQ(In("m/s^2", "2 m s-2"), "2");
  EXPECT_EQ(In("rad", "180 deg"), "3.141592653589793");
  EXPECT_EQ(In("rad", "180°"), "3.141592653589793");
  EXPECT_EQ(In("rad/s", "90 deg/s"), "1.5707963267948966");
  EXPECT_EQ(In("deg", "90 deg"), "90");
  EXPECT_EQ(In("s", "1.5 min"), "90");
  EXPECT_EQ(In("s", "20 ms"), "0.02");
  EXPECT_EQ(In("1/s", "5 Hz"), "5");
  EXPECT_EQ(In("Hz", "2 kHz"), "2000");
  EXPECT_EQ(In("N", "3 kg*m/s^2"), "3");
  EXPECT_EQ(In("1", "25 %"), "0.25");
  EXPECT_EQ(In("B", "16 B"), "16");
}

TEST(NumberInUnit, LeavesWhatHasNoneToItsReader) {
  for (const char* text : {"15", " 15 ", "", "many", "1e3", "nan"}) {
    EXPECT_EQ(In("m", text), text);
    EXPECT_EQ(In("", text), text);
  }
}

TEST(NumberInUnit, OfSomethingElseIsRefusedWithTheUnitThatIsWanted) {
  EXPECT_THAT(In("m", "15 s"), AllOf(HasSubstr("'15 s'"), HasSubstr("write it in m")));
  EXPECT_THAT(In("rad", "15 m"), HasSubstr("write it in rad"));
  EXPECT_THAT(In("m/s", "15 m"), HasSubstr("write it in m/s"));
  EXPECT_THAT(In("m", "15 cmm"), AllOf(HasSubstr("no number with a unit"), HasSubstr("write it in m")));
  EXPECT_THAT(In("B", "15 m"), HasSubstr("write it in B"));
  EXPECT_THAT(In("", "15 m"), HasSubstr("write the number only"));
  for (const char* text : {"1 /", "1 m/", "1 m//s^", "1 m^9", "1 ^2", "1 m^", "1 \xff"}) {
    EXPECT_FALSE(NumberInUnit(text, "m")) << text;
  }
}

class MeasuredGuard final : public Module {
 public:
  using Module::Module;
  Parameter<double> distance{this, "distance", {.default_value = 0.3, .bounds = {0.0, 5.0}, .unit = "m"}};
  Parameter<int> count{this, "count", {.default_value = 2}};
  StaticParameter<std::string> word{this, "word"};

 private:
  void Update() override {}
};

class ParameterUnits : public testing::Test {
 protected:
  std::string Set(Configurable& parameter, std::string_view text) {
    const auto set = parameter.SetFromText(text);
    return set ? parameter.ToText() : set.error().ToString();
  }
  Runtime runtime_;
  MeasuredGuard& guard_ = runtime_.Create<MeasuredGuard>(runtime_.root(), "guard");
};

TEST_F(ParameterUnits, AreUnderstoodWhereverAValueIsText) {
  EXPECT_EQ(Set(guard_.distance, "15 cm"), "0.15");
  EXPECT_EQ(Set(guard_.distance, "0.2"), "0.2");
  EXPECT_THAT(Set(guard_.distance, "7000 mm"), HasSubstr("7 m is out of bounds"));
  EXPECT_THAT(Set(guard_.distance, "15 deg"), HasSubstr("write it in m"));
  EXPECT_THAT(Set(guard_.distance, "near"), HasSubstr("it is in m"));
  EXPECT_THAT(Set(guard_.count, "15 cm"), HasSubstr("where none is wanted"));
  EXPECT_EQ(guard_.distance.Get(), 0.2);
}

TEST_F(ParameterUnits, DoNotLetThroughWhatNoFileCanCarry) {
  EXPECT_THAT(Set(guard_.word, "a\x07"),
              AllOf(HasSubstr("/guard/parameter/word"), HasSubstr("control character 0x07")));
  EXPECT_THAT(Set(guard_.word, "a\xff"), HasSubstr("byte 0xff"));
  EXPECT_EQ(Set(guard_.word, "15 cm\n\t"), "15 cm\n\t");
}

}  // namespace
}  // namespace runnel
