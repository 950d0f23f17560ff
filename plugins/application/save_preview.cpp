#include "plugins/application/save_preview.h"

#include <mutex>
#include <system_error>
#include <utility>

#include "core/element/runtime.h"
#include "core/xml/xml_document.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/saving/saving.h"

namespace runnel {

Result<SavePreview> PreviewSave(FrameworkElement& application, const SaveTools& tools,
                                const std::filesystem::path& file) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  const auto* const source = application.FindAnnotation<ApplicationSource>();
  if (file.empty() && source == nullptr) {
    return Error{.message = "the application was built by code, and has no file yet",
                 .path = application.path(),
                 .hint = "name one"};
  }
  SavePreview preview{file.empty() ? source->file : file, {}, {}};
  auto text = internal::TextOfApplication(application, tools, preview.file.parent_path());
  if (!text) return text.error();
  preview.after = std::move(text->text);
  std::error_code ignored;
  if (std::filesystem::exists(preview.file, ignored)) {
    auto before = XmlDocument::ReadText(preview.file);
    if (!before) return before.error();
    preview.before = std::move(*before);
  }
  return preview;
}

}  // namespace runnel
