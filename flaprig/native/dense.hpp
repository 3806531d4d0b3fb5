// Small dense linear systems: LU with partial pivoting.
#pragma once

#include <vector>

namespace flaprig {

// row-major n x n
class Lu {
 public:
  // throws std::runtime_error when the matrix is singular
  Lu(std::vector<double> matrix, int n);
  // like the constructor, for hot loops: reuses memory; false when singular
  bool factor(const std::vector<double>& matrix, int n);
  Lu() = default;
  // overwrites b with the solution
  void solve(double* b) const;
  std::vector<double> inverse() const;

 private:
  int n_ = 0;
  std::vector<double> a_;
  std::vector<int> pivot_;
};

}  // namespace flaprig
