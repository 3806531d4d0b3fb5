#include "dense.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "stop.hpp"

namespace flaprig {

Lu::Lu(std::vector<double> matrix, int n) {
  if (!factor(matrix, n)) throw std::runtime_error("the influence matrix is singular");
}

bool Lu::factor(const std::vector<double>& matrix, int n) {
  n_ = n, a_ = matrix, pivot_.resize(n);
  for (int k = 0; k < n; ++k) {
    check_stop();
    int best = k;
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(a_[i * n + k]) > std::abs(a_[best * n + k])) best = i;
    }
    pivot_[k] = best;
    if (!(std::abs(a_[best * n + k]) > 0)) return false;  // NaN too
    if (best != k) {
      for (int j = 0; j < n; ++j) std::swap(a_[k * n + j], a_[best * n + j]);
    }
    for (int i = k + 1; i < n; ++i) {
      const double f = a_[i * n + k] /= a_[k * n + k];
      for (int j = k + 1; j < n; ++j) a_[i * n + j] -= f * a_[k * n + j];
    }
  }
  return true;
}

void Lu::solve(double* b) const {
  for (int k = 0; k < n_; ++k) std::swap(b[k], b[pivot_[k]]);
  for (int i = 1; i < n_; ++i) {
    for (int j = 0; j < i; ++j) b[i] -= a_[i * n_ + j] * b[j];
  }
  for (int i = n_ - 1; i >= 0; --i) {
    for (int j = i + 1; j < n_; ++j) b[i] -= a_[i * n_ + j] * b[j];
    b[i] /= a_[i * n_ + i];
  }
}

std::vector<double> Lu::inverse() const {
  std::vector<double> result(n_ * n_), column(n_);
  for (int j = 0; j < n_; ++j) {
    check_stop();
    for (int i = 0; i < n_; ++i) column[i] = i == j ? 1 : 0;
    solve(column.data());
    for (int i = 0; i < n_; ++i) result[i * n_ + j] = column[i];
  }
  return result;
}

}  // namespace flaprig
