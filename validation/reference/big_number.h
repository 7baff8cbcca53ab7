// The two kinds of exact number the judge computes in. Boost.Multiprecision, not GMP: header only, nothing to link.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace etalon::validation::reference {

/// Signed integers without limit; up to 512 bits they live in place, beyond that on the heap: no width can be got wrong.
using BigInt = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked,
                                           std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;

/// Reduced fractions without limit.
using BigRational = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

}  // namespace etalon::validation::reference
