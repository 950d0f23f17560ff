#include <gtest/gtest.h>

#include "core/base/error.h"

namespace runnel {
namespace {

TEST(ErrorTest, NamesFileLineColumnPathMessageAndHint) {
  const Error error{"no port 'scna'", "/robot/guard", {"app.xml", 3, 7}, "did you mean 'scan'?"};
  EXPECT_EQ(error.ToString(), "app.xml:3:7: /robot/guard: no port 'scna'; did you mean 'scan'?");
}

TEST(ErrorTest, LeavesOutWhatIsUnknown) { EXPECT_EQ(Error{.message = "it failed"}.ToString(), "it failed"); }

TEST(DiagnosticsTest, WarningsDoNotMakeAnInputWrong) {
  Diagnostics diagnostics;
  diagnostics.AddWarning({.message = "odd"});
  EXPECT_TRUE(diagnostics.ok());
  diagnostics.Add({.message = "wrong"});
  EXPECT_FALSE(diagnostics.ok());
}

TEST(DiagnosticsTest, ListsErrorsInTheOrderOfTheFileThenWarnings) {
  Diagnostics diagnostics;
  diagnostics.AddWarning({"w", "", {"a.xml", 1, 1}});
  diagnostics.Add({"second", "/b", {"a.xml", 9, 1}});
  diagnostics.Add({"first", "/a", {"a.xml", 2, 5}});
  EXPECT_EQ(diagnostics.ToString(),
            "a.xml:2:5: error: /a: first\n"
            "a.xml:9:1: error: /b: second\n"
            "a.xml:1:1: warning: w\n");
}

}  // namespace
}  // namespace runnel
