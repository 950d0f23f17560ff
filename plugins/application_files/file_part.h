#pragma once

#include <string>
#include <utility>

#include "plugins/application_files/file_update.h"

namespace runnel::internal {

/// The inside of one group that another file describes.
struct FileUpdate::Part {
  Part(XmlDocument parsed, const std::string& text, Saving& saving, const ApplicationSource& source)
      : document(std::move(parsed)), editor(document, text), update(saving, source, editor) {}

  XmlDocument document;
  XmlEditor editor;
  FileUpdate update;
};

}  // namespace runnel::internal
