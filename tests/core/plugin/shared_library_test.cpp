#include "core/plugin/shared_library.h"

#include <gmock/gmock.h>

namespace runnel {
namespace {

using testing::HasSubstr;

TEST(SharedLibraryTest, FindsWhatTheLibraryExportsAndNothingElse) {
  const auto library = SharedLibrary::Open(RUNNEL_TEST_PLUGINS "/no_entry.so");
  ASSERT_TRUE(library);
  EXPECT_NE(library->FindSymbol("Unrelated"), nullptr);
  EXPECT_EQ(library->FindSymbol("RunnelNoSuchFunction"), nullptr);
  EXPECT_EQ(library->file(), RUNNEL_TEST_PLUGINS "/no_entry.so");
}

TEST(SharedLibraryTest, SaysInTheLinkersWordsWhatIsWrong) {
  const auto text = SharedLibrary::Open(RUNNEL_TEST_PLUGINS "/not_a_library.so");
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error().message, HasSubstr("cannot load the library"));
  EXPECT_THAT(text.error().message, HasSubstr("not_a_library.so"));
  const auto missing = SharedLibrary::Open(RUNNEL_TEST_PLUGINS "/missing_symbol.so");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("RunnelTestFunctionThatIsNowhere"));
}

}  // namespace
}  // namespace runnel
