// What a tag of the file has made, and somebody uses as long as it runs, is neither deleted nor renamed nor copied.

#include "core/element/file_notes.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {
namespace {

/// As the network of an application is one, and the words of its topics are.
class PartOfTag final : public FrameworkElement {
 public:
  explicit PartOfTag(const Placement& placement) : FrameworkElement(placement, ElementKind::kGroup) {
    Annotate(std::make_unique<NotSaved>());
  }
};

class PartsOfTags : public EditorTest {
 protected:
  PartsOfTags() {
    auto& app = At<Group>("/app");
    auto& part = runtime.Create<PartOfTag>(app, "network");
    runtime.Create<PartOfTag>(part, "word");
    MustReady();
  }
};

TEST_F(PartsOfTags, StayAsTheyAre) {
  for (const std::string path : {"/app/network", "/app/network/word"}) {
    EXPECT_THAT(Refusal({DeleteElement{path}}),
                HasSubstr("what a tag of the file or a program has made for itself, and cannot be deleted"));
    EXPECT_THAT(Refusal({RenameElement{path, "other"}}), HasSubstr("cannot be renamed"));
    EXPECT_THAT(Refusal({CopyElement{path}}), HasSubstr("cannot be copied"));
  }
}

TEST_F(PartsOfTags, AreNotDeletedWithWhatIsAroundThem) {
  EXPECT_THAT(Refusal({DeleteElement{"/app"}}), HasSubstr("what a tag of the file or a program has made"));
}

TEST_F(PartsOfTags, AreNoThreads) {
  runtime.Create<Group>(At<Group>("/app"), "threads").Annotate(std::make_unique<NotSaved>());
  MustReady();
  Must({DeleteElement{"/app/threads"}});
}

TEST_F(PartsOfTags, OfModulesGoWithThese) {
  Must({CreateModule{"/app/module", "test/silent"}});
  runtime.Create<PartOfTag>(At<Silent>("/app/module"), "worker");
  MustReady();
  Must({DeleteElement{"/app/module"}});
  EXPECT_FALSE(Exists("/app/module"));
}

}  // namespace
}  // namespace runnel::test
