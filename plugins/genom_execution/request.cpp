#include "plugins/genom_execution/request.h"

namespace runnel::genom_execution {

Request::Request(const ComponentTable& component, const ServiceTable& service)
    : service_(service),
      data_(service.make != nullptr ? service.make() : nullptr),
      outcome_(component.largest_detail) {}

Request::~Request() {
  if (data_ != nullptr && service_.destroy != nullptr) service_.destroy(data_);
}

}  // namespace runnel::genom_execution
