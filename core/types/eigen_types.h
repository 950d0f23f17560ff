#pragma once

#include <string>
#include <utility>

#include <Eigen/Core>

#include "core/types/type_of.h"

/// Descriptions of Eigen's vectors and matrices, of fixed and of free size: "vector double[3]" for
/// a Vector3d, "vector double[]" for a VectorXd, "matrix double[2x3]", "matrix double[,]". In a
/// header of its own, since Eigen's are heavy.

namespace runnel {

namespace internal {

template <typename M>
constexpr bool kIsEigenVector = M::RowsAtCompileTime == 1 || M::ColsAtCompileTime == 1;

template <typename M>
std::string EigenName() {
  const auto extent = [](int size) { return size == Eigen::Dynamic ? std::string() : std::to_string(size); };
  const std::string& scalar = TypeOf<typename M::Scalar>().name();
  if constexpr (M::ColsAtCompileTime == 1) {
    return "vector " + scalar + "[" + extent(M::RowsAtCompileTime) + "]";
  } else if constexpr (M::RowsAtCompileTime == 1) {
    return "row " + scalar + "[" + extent(M::ColsAtCompileTime) + "]";
  } else {
    const std::string times =
        M::RowsAtCompileTime == Eigen::Dynamic && M::ColsAtCompileTime == Eigen::Dynamic ? "," : "x";
    return "matrix " + scalar + "[" + extent(M::RowsAtCompileTime) + times + extent(M::ColsAtCompileTime) + "]";
  }
}

/// What ElementOperations calls rows and columns: a vector of either direction is one row.
template <typename M>
bool ResizeEigen(M& matrix, std::size_t rows, std::size_t columns) {
  if (rows > std::size_t{1} << 30 || columns > std::size_t{1} << 30) return false;
  auto to_rows = static_cast<Eigen::Index>(rows);
  auto to_columns = static_cast<Eigen::Index>(columns);
  if constexpr (M::ColsAtCompileTime == 1) {
    std::swap(to_rows, to_columns);
    to_columns = 1;
  }
  const auto possible = [](int fixed, int maximum, Eigen::Index wanted) {
    return (fixed == Eigen::Dynamic || fixed == wanted) && (maximum == Eigen::Dynamic || wanted <= maximum);
  };
  if (!possible(M::RowsAtCompileTime, M::MaxRowsAtCompileTime, to_rows) ||
      !possible(M::ColsAtCompileTime, M::MaxColsAtCompileTime, to_columns)) {
    return false;
  }
  if constexpr (M::SizeAtCompileTime == Eigen::Dynamic) {
    matrix.conservativeResize(to_rows, to_columns);
  }
  return true;
}

}  // namespace internal

template <typename S, int rows, int columns, int options, int max_rows, int max_columns>
void Describe(TypeBuilder<Eigen::Matrix<S, rows, columns, options, max_rows, max_columns>>& type) {
  using M = Eigen::Matrix<S, rows, columns, options, max_rows, max_columns>;
  constexpr bool is_vector = internal::kIsEigenVector<M>;
  type.Name(internal::EigenName<M>())
      .Elements(is_vector ? TypeKind::kSequence : TypeKind::kMatrix,
                {.type = &TypeOf<S>(),
                 .is_fixed = rows != Eigen::Dynamic && columns != Eigen::Dynamic,
                 .rows = [](const void* at) -> std::size_t {
                   return is_vector ? 1 : static_cast<std::size_t>(static_cast<const M*>(at)->rows());
                 },
                 .columns = [](const void* at) -> std::size_t {
                   const M& matrix = *static_cast<const M*>(at);
                   return static_cast<std::size_t>(is_vector ? matrix.size() : matrix.cols());
                 },
                 .resize =
                     [](void* at, std::size_t to_rows, std::size_t to_columns) {
                       return internal::ResizeEigen(*static_cast<M*>(at), to_rows, to_columns);
                     },
                 .element = [](void* at, std::size_t index) -> void* {
                   M& matrix = *static_cast<M*>(at);
                   const auto i = static_cast<Eigen::Index>(index);
                   if constexpr (is_vector) return &matrix(i);
                   return &matrix(i / matrix.cols(), i % matrix.cols());
                 },
                 .are_plain_numbers = kIsPlainNumber<S> && (is_vector || M::IsRowMajor)});
}

}  // namespace runnel
