// Whatever stands in an application file: it is built, or refused with errors and nothing left.
// A million of them: fuzz_application_files.

#include "tests/plugins/application_files/reading/random_files.h"

#include <gtest/gtest.h>

#include "tests/plugins/application_files/reading/file_trial.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

TEST(RandomFiles, OfTheCorpusAreRightUnlessTheyDescribeGroups) {
  const TestFolder folder;
  FileTrial trial(folder.path(), RUNNEL_CORPUS);
  RandomFiles files(1, RUNNEL_CORPUS);
  std::uint64_t applications = 0;
  for (const std::string& text : files.corpus()) {
    if (text.find("<group_type") != std::string::npos) continue;
    ++applications;
    EXPECT_EQ(trial.Try(text, 3), "") << text;
    EXPECT_EQ(trial.counts().built, applications) << text;
  }
  EXPECT_GT(applications, 5U);
}

TEST(RandomFiles, AreTheSameForTheSameSeed) {
  RandomFiles one(7, RUNNEL_CORPUS);
  RandomFiles same(7, RUNNEL_CORPUS);
  RandomFiles other(8, RUNNEL_CORPUS);
  const std::string text = one.Make(1000);
  EXPECT_NE(text, one.Make(1001));
  EXPECT_EQ(text, same.Make(1000));
  EXPECT_NE(text, other.Make(1000));
}

TEST(RandomFiles, AreBuiltOrRefusedWithNothingLeft) {
  const TestFolder folder;
  FileTrial trial(folder.path(), RUNNEL_CORPUS);
  RandomFiles files(1, RUNNEL_CORPUS);
  constexpr std::uint64_t kCount = 10'000;
  for (std::uint64_t number = 0; number < kCount; ++number) {
    const std::string text = files.Make(number);
    ASSERT_EQ(trial.Try(text, number), "") << "input " << number << ":\n" << text;
  }
  // Or else they would try little.
  EXPECT_GT(trial.counts().unreadable, kCount / 50);
  EXPECT_GT(trial.counts().refused, kCount / 10);
  EXPECT_GT(trial.counts().built, kCount / 20);
  EXPECT_GT(trial.counts().saved, kCount / 100);
}

}  // namespace
}  // namespace runnel::testing
