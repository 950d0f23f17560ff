// What Cyclone DDS calls a sertype and its serdata, for values that are made and read elsewhere. Its own layer for ROS
// does the same.
#include "plugins/wire_cyclone/octets_type.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <dds/ddsi/ddsi_keyhash.h>
#include <dds/ddsi/q_radmin.h>

#ifndef DDS_HAS_SHM
#error "Debian's libddsc has shared memory: without DDS_HAS_SHM its structures are laid out in another way"
#endif

namespace runnel {

namespace {

extern const ddsi_serdata_ops kValueOperations;

const OctetsValue& Of(const ddsi_serdata* value) { return *static_cast<const OctetsValue*>(value); }

ddsi_serdata* Make(const ddsi_sertype* type, ddsi_serdata_kind kind, std::shared_ptr<const Octets> octets) noexcept {
  auto* const value = new OctetsValue;
  ddsi_serdata_init(value, type, kind);
  value->octets = std::move(octets);
  return value;
}

// Nothing may be thrown through Cyclone DDS, which is written in C. What there is no memory for is lost, as what is malformed.
template <typename Fill>
ddsi_serdata* Filled(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size, const Fill& fill) noexcept {
  try {
    auto octets = std::make_shared<Octets>();
    octets->reserve(size);
    fill(*octets);
    return octets->size() == size ? Make(type, kind, std::move(octets)) : nullptr;
  } catch (...) {
    return nullptr;
  }
}

// What has come: pieces that may overlap, of which those before have been taken.
ddsi_serdata* FromPieces(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* piece, std::size_t size) {
  return Filled(type, kind, size, [&](Octets& octets) {
    for (; piece != nullptr; piece = piece->nextfrag) {
      const std::size_t end = std::min<std::size_t>(piece->maxp1, size);
      if (piece->min > octets.size()) return;
      if (end <= octets.size()) continue;
      const auto* const payload =
          reinterpret_cast<const std::byte*>(NN_RMSG_PAYLOADOFF(piece->rmsg, NN_RDATA_PAYLOAD_OFF(piece)));
      octets.insert(octets.end(), payload + (octets.size() - piece->min), payload + (end - piece->min));
    }
  });
}

ddsi_serdata* FromVector(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                         const ddsrt_iovec_t* parts, std::size_t size) {
  return Filled(type, kind, size, [&](Octets& octets) {
    for (ddsrt_msg_iovlen_t i = 0; i < count && octets.size() < size; ++i) {
      const auto* const begin = static_cast<const std::byte*>(parts[i].iov_base);
      octets.insert(octets.end(), begin, begin + std::min<std::size_t>(parts[i].iov_len, size - octets.size()));
    }
  });
}

void ToOctets(const ddsi_serdata* value, std::size_t begin, std::size_t size, void* to) {
  const Octets& octets = *Of(value).octets;
  const std::size_t there = begin < octets.size() ? std::min(size, octets.size() - begin) : 0;
  if (there > 0) std::memcpy(to, octets.data() + begin, there);
  std::memset(static_cast<char*>(to) + there, 0, size - there);
}

ddsi_serdata* LendOctets(const ddsi_serdata* value, std::size_t begin, std::size_t size, ddsrt_iovec_t* lent) {
  lent->iov_base = const_cast<std::byte*>(Of(value).octets->data()) + begin;
  lent->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(value);
}

ddsi_serdata* WithoutType(const ddsi_serdata* value) {
  ddsi_serdata* const key = Make(value->type, SDK_KEY, std::make_shared<Octets>());
  key->type = nullptr;
  return key;
}

std::size_t Print(const ddsi_sertype*, const ddsi_serdata*, char* text, std::size_t) {
  *text = '\0';
  return 0;
}

const ddsi_serdata_ops kValueOperations = {
    // Values without keys are all of one instance.
    .eqkey = [](const ddsi_serdata*, const ddsi_serdata*) { return true; },
    .get_size = [](const ddsi_serdata* value) { return static_cast<std::uint32_t>(Of(value).octets->size()); },
    .from_ser = FromPieces,
    .from_ser_iov = FromVector,
    .from_keyhash = [](const ddsi_sertype* type,
                       const ddsi_keyhash*) { return Make(type, SDK_KEY, std::make_shared<Octets>()); },
    // Nobody writes other values than octets.
    .from_sample = [](const ddsi_sertype*, ddsi_serdata_kind, const void*) -> ddsi_serdata* { return nullptr; },
    .to_ser = ToOctets,
    .to_ser_ref = LendOctets,
    .to_ser_unref = [](ddsi_serdata* value, const ddsrt_iovec_t*) { ddsi_serdata_unref(value); },
    .to_sample = [](const ddsi_serdata*, void*, void**, void*) { return false; },
    .to_untyped = WithoutType,
    .untyped_to_sample = [](const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return true; },
    .free = [](ddsi_serdata* value) { delete static_cast<OctetsValue*>(value); },
    .print = Print,
    .get_keyhash = [](const ddsi_serdata*, ddsi_keyhash* hash, bool) { std::memset(hash, 0, sizeof *hash); },
    .get_sample_size = nullptr,
    .from_iox_buffer = nullptr,
};

void FreeType(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}

const ddsi_sertype_ops kTypeOperations = {
    .version = ddsi_sertype_v0,
    .arg = nullptr,
    .free = FreeType,
    .zero_samples = [](const ddsi_sertype*, void*, std::size_t) {},
    .realloc_samples = [](void**, const ddsi_sertype*, void*, std::size_t, std::size_t) {},
    .free_samples = [](const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {},
    .equal = [](const ddsi_sertype*, const ddsi_sertype*) { return true; },
    .hash = [](const ddsi_sertype*) { return 0u; },
    .type_id = nullptr,
    .type_map = nullptr,
    .type_info = nullptr,
    .derive_sertype = nullptr,
    .get_serialized_size = nullptr,
    .serialize_into = nullptr,
};

}  // namespace

ddsi_sertype* MakeOctetsType(const std::string& name) {
  auto* const type = new ddsi_sertype{};
  ddsi_sertype_init(type, name.c_str(), &kTypeOperations, &kValueOperations, true);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type;
}

ddsi_serdata* MakeOctetsValue(const ddsi_sertype& type, std::shared_ptr<const Octets> octets,
                              std::int64_t source_time) {
  ddsi_serdata* const value = Make(&type, SDK_DATA, std::move(octets));
  value->timestamp.v = source_time;
  value->statusinfo = 0;
  return value;
}

}  // namespace runnel
