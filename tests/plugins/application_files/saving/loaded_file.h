#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {

/// A file with one of everything, in a formatting of its own.
inline const char* const kFile = R"(<?xml version="1.0"?>
<!-- of the whole -->
<application   name='demo' >

  <thread name="slow" period="0.05 s"/>
  <thread name="fast" period="10ms"/>   <!-- of the thread -->

  <module name="source" type="test/source" thread="slow">
    <!-- of the gain -->
    <parameter name='gain'   value='2.50'/>
    <parameter name="count" value="4" command_line="count"/>
  </module>
  <group name="inner">
      <port name="in" direction="input"/>
      <module name="filter" type="test/filter"/><!-- of the filter -->
      <module name="sink" type="test/sink"/>
      <connect from="in" to="filter/value  sink/second"/>
      <connect from="filter/value" to="sink/value" queue="3" on_full="refuse"/>
  </group>

  <connect from="source/value" to="inner/in"/>
  <on_fault of="inner/filter" action="quit"/>
</application>
<!-- the end -->
)";

/// An application loaded from it, and what would be saved of that.
class LoadedFile : public ::testing::Test {
 protected:
  FrameworkElement& Load(const std::string& text = kFile) {
    WriteAll(file_, text);
    application_ = shop_.Load(file_);
    return *application_;
  }
  std::string Text() { return shop_.Text(*application_, folder_.path()); }
  // What the file is after `from` has become `to`.
  static std::string With(const std::string& from, const std::string& to, std::string text = kFile) {
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
  }
  template <typename T>
  T& Get(const std::string& path) {
    return shop_.Get<T>(path);
  }
  FrameworkElement& Create(const std::string& type, const std::string& parent, const std::string& name) {
    return *shop_.plugins.modules().Create(type, Get<FrameworkElement>(parent), name).value();
  }
  void Delete(const std::string& path) {
    const auto deleted = shop_.runtime.Delete(Get<FrameworkElement>(path));
    ASSERT_TRUE(deleted) << deleted.error().ToString();
  }

  TestFolder folder_;
  std::filesystem::path file_ = folder_ / "app.xml";
  SavingWorkshop shop_;
  FrameworkElement* application_ = nullptr;
};

}  // namespace runnel::testing
