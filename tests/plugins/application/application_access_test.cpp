// Elements by path, values in and out, and changes, from outside of cycles.

#include <gmock/gmock.h>

#include "plugins/application/run_report.h"
#include "tests/plugins/application/counting_modules.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class ApplicationAccess : public testing::Test {
 protected:
  ApplicationAccess() : loaded_(LoadCounting(kCounting)), application_(*loaded_) {}
  double Newest(std::string_view path) { return application_.Read<double>(path).value().value_or(0); }
  LoadedApplication loaded_;
  Application& application_;
};

TEST_F(ApplicationAccess, FindsPortsAndParametersByTheirPaths) {
  const auto count = application_.Find<Output<double>>("/source/count");
  ASSERT_TRUE(count) << count.error().ToString();
  EXPECT_EQ((*count)->path(), "/counting/source/output/count");
  EXPECT_TRUE(application_.Find<Output<double>>("/counting/source/output/count"));
  EXPECT_TRUE(application_.Find<Input<double>>("/filter/in"));
  EXPECT_TRUE(application_.Find<CountingFilter>("/filter"));
  const auto factor = application_.Find<Parameter<double>>("/source/factor");
  ASSERT_TRUE(factor) << factor.error().ToString();
  ASSERT_TRUE((*factor)->Set(3));
  ASSERT_TRUE(application_.RunCycles(1));
  EXPECT_EQ(Newest("/source/count"), 3);
}

TEST_F(ApplicationAccess, NamesTheNearestOfWhatIsNotThere) {
  EXPECT_THAT(application_.Find<Output<double>>("/source/cont").error().ToString(), HasSubstr("did you mean 'count'?"));
  EXPECT_THAT(application_.Find<Parameter<double>>("/source/facto").error().ToString(),
              HasSubstr("did you mean 'factor'?"));
  EXPECT_THAT(application_.Find<CountingFilter>("/fliter").error().ToString(), HasSubstr("did you mean 'filter'?"));
  EXPECT_FALSE(application_.Set("/source/facto", "1"));
  EXPECT_FALSE(application_.Get("/source/facto"));
}

TEST_F(ApplicationAccess, SaysWhatIsThereInstead) {
  EXPECT_EQ(application_.Find<Output<int>>("/source/count").error().ToString(),
            "/counting/source/output/count: this is an output of type double, not an output of "
            "type int32");
  EXPECT_THAT(application_.Find<Output<double>>("/filter/in").error().message,
              "this is an input of type double, not an output of type double");
  EXPECT_THAT(application_.Find<CountingSource>("/filter").error().message, HasSubstr("this is a module"));
  EXPECT_THAT(application_.Read<int>("/source/count").error().message,
              "this is an output of type double, not a port of type int32");
}

TEST_F(ApplicationAccess, ReadsTheNewestValueOnceThereIsOne) {
  EXPECT_FALSE(application_.Read<double>("/source/count").value());
  ASSERT_TRUE(application_.RunCycles(2));
  EXPECT_EQ(application_.Read<double>("/source/count").value(), 2.0);
  EXPECT_EQ(application_.Read<double>("/filter/in").value(), 2.0) << "what an input reads";
}

TEST_F(ApplicationAccess, ReadsAndPublishesThroughPortsThatOutliveSwaps) {
  const auto heard = application_.InputFrom<double>("/judge/out", {.queue = 100});
  ASSERT_TRUE(heard) << heard.error().ToString();
  ASSERT_TRUE(application_.RunCycles(2));
  ASSERT_TRUE(application_.Swap("/judge", "counting/filter"));
  ASSERT_TRUE(application_.RunCycles(2));
  std::vector<double> values;
  while (const auto value = (*heard)->Take()) values.push_back(*value);
  EXPECT_THAT(values, testing::ElementsAre(-1001, -1002, 2003, 2004));

  ASSERT_TRUE(application_.Apply("disconnect /source/count /filter/in"));
  const auto told = application_.OutputTo<double>("/filter/in");
  ASSERT_TRUE(told) << told.error().ToString();
  (*told)->Publish(70);
  ASSERT_TRUE(application_.RunCycles(1));
  EXPECT_EQ(Newest("/filter/out"), 1070);
  ASSERT_TRUE(application_.Swap("/filter", "counting/judge"));
  (*told)->Publish(80);
  ASSERT_TRUE(application_.RunCycles(1));
  EXPECT_EQ(Newest("/filter/out"), -80);
}

TEST_F(ApplicationAccess, TiesNothingToWhatIsNotThere) {
  const std::size_t before = application_.runtime().root().children().size();
  EXPECT_THAT(application_.InputFrom<double>("/judge/outt").error().ToString(), HasSubstr("did you mean 'out'?"));
  EXPECT_FALSE(application_.OutputTo<std::string>("/judge/in")) << "a text is read by name only";
  EXPECT_EQ(application_.runtime().root().children().size(), before);
}

TEST_F(ApplicationAccess, ChangesAllOrNothingAndTakesItBack) {
  EXPECT_FALSE(application_.Apply("set /source/factor 2; set /source/factor 99"));
  EXPECT_EQ(application_.Get("/source/factor").value(), "1");
  ASSERT_TRUE(application_.Set("/source/factor", "2"));
  ASSERT_TRUE(application_.Swap("/judge", "counting/filter"));
  EXPECT_TRUE(application_.Find<CountingFilter>("/judge"));
  ASSERT_TRUE(application_.Undo());
  EXPECT_TRUE(application_.Find<CountingJudge>("/judge"));
  ASSERT_TRUE(application_.Undo());
  EXPECT_EQ(application_.Get("/source/factor").value(), "1");
  ASSERT_TRUE(application_.Redo());
  EXPECT_EQ(application_.Get("/source/factor").value(), "2");
  const auto wrong = application_.Swap("/judge", "counting/fliter");
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.diagnostics.ToString(), HasSubstr("did you mean 'counting/filter'?"));
}

}  // namespace
}  // namespace runnel::test
