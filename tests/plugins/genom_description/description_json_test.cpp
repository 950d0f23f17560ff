#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "plugins/genom_description/description.h"
#include "tests/plugins/genom_description/verdict.h"

namespace runnel::test {
namespace {

using nlohmann::json;

json JsonOf(const std::string& text) {
  Diagnostics diagnostics;
  const auto description = genom::ReadDescriptionText(text, "test.gen", {}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  return json::parse(genom::DescriptionJson(*description));
}

const json& Named(const json& list, const std::string& name) {
  for (const json& each : list) {
    if (each["name"] == name) return each;
  }
  ADD_FAILURE() << "there is no " << name;
  return list;
}

TEST(GenomJsonTest, HasAllOfAComponent) {
  const json all = JsonOf(FileText("courier.gen"));
  EXPECT_EQ(all["notice"], " shown by templates at the top of what they generate ");
  EXPECT_EQ(all["masquerades"]["runnel"]["nav::pose"], "Pose2");
  const json& courier = Named(all["components"], "courier");
  EXPECT_EQ(courier["doc"], "Carries things.\nAnd brings them back.");
  EXPECT_EQ(courier["provides"], json::array({"haltable"}));
  const json& drive = Named(courier["tasks"], "drive");
  EXPECT_DOUBLE_EQ(drive["period"], 0.02);
  EXPECT_DOUBLE_EQ(drive["stack"], 65536);
  EXPECT_EQ(Named(courier["ports"], "plans")["is_multiple"], true);
  const json& go = Named(courier["services"], "go");
  EXPECT_EQ(go["throws"], json::array({"courier::no_pose", "haltable::refused"}));
  EXPECT_EQ(go["states"]["stop"], "c_done");
  EXPECT_EQ(go["variables"].size(), 2u);
  const json& via = Named(go["parameters"], "via");
  EXPECT_EQ(via["default"]["doc"], "points to pass");
  EXPECT_EQ(via["default"]["parts"][1]["index"], 3);
  EXPECT_EQ(via["default"]["parts"][1]["parts"][0]["value"], 4);
  EXPECT_EQ(Named(courier["remotes"], "beep")["parameters"][0]["default"]["value"], 1);
  EXPECT_EQ(Named(go["codels"], "c_call")["parameters"][0]["remote"], "beep");
  EXPECT_EQ(Named(Named(courier["tasks"], "link")["codels"], "c_poll")["is_async"], true);
}

TEST(GenomJsonTest, TypesHaveTheLayoutOfC) {
  const json types = JsonOf(
      "struct s { octet a; double b; short c; }; enum e { A, B }; native n;"
      "typedef sequence<s, 2> bounded; typedef sequence<s> unbounded; typedef optional<double> maybe;"
      "union u switch(e) { case A: octet a; default: double b; };"
      "struct all { char text[3]; string<5> name; string any_length; long grid[2][3]; n own; };")["types"];
  EXPECT_EQ(Named(types, "s")["size"], 24);
  EXPECT_EQ(Named(types, "s")["members"][2]["offset"], 16);
  EXPECT_EQ(Named(types, "bounded")["size"], 56);
  EXPECT_EQ(Named(types, "unbounded")["size"], 24);
  EXPECT_EQ(Named(types, "maybe")["size"], 16);
  EXPECT_EQ(Named(types, "u")["size"], 16);
  EXPECT_EQ(Named(types, "u")["members"][0]["labels"], json::array({"A"}));
  EXPECT_EQ(Named(types, "u")["members"][1]["is_default"], true);
  EXPECT_EQ(Named(types, "all")["members"][2]["offset"], 8);
  EXPECT_EQ(Named(types, "all")["size"], 48);
  EXPECT_EQ(Named(types, "e")["enumerators"], json::array({"A", "B"}));
}

TEST(GenomJsonTest, TheDigestIsThatOfWhatOthersSee) {
  const auto digest = [](const std::string& items) {
    return JsonOf("struct s { long a; }; component c { " + items + " };")["components"][0]["digest"];
  };
  const json plain = digest("port in s p; function f(in long a);");
  EXPECT_EQ(plain,
            digest("doc \"d\"; port in s p { doc \"e\"; }; function f(in long a = 3) { codel k(in a); }; task t;"));
  EXPECT_NE(plain, digest("port out s p; function f(in long a);"));
  EXPECT_NE(plain, digest("port in s p; function f(in short a);"));
  EXPECT_NE(plain, digest("port in s p; function f(in long a); function g();"));
  EXPECT_NE(plain, digest("port in s p; function f(in long b);")) << "requests say parameters by name";
  const std::string items = "exception e; port in s p; ";
  EXPECT_NE(digest(items + "function f(in long a);"), digest(items + "throw e; function f(in long a);"));
  EXPECT_EQ(digest(items + "throw e; function f(in long a);"), digest(items + "function f(in long a) { throw e; };"));
  const std::string in_task = "activity f(in long a) { task t; codel<start> k() yield ether; };";
  EXPECT_NE(digest(items + "task t; " + in_task), digest(items + "task t { throw e; }; " + in_task));
}

}  // namespace
}  // namespace runnel::test
