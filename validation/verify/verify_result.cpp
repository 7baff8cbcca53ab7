#include "validation/verify/verify_result.h"

namespace etalon::validation {

ClassTally& ClassTally::operator+=(const ClassTally& other) {
  texels += other.texels;
  identical += other.identical;
  rounding += other.rounding;
  tie += other.tie;
  unbounded += other.unbounded;
  unexplained += other.unexplained;
  return *this;
}

ClassTally JobResult::tally() const {
  ClassTally sum;
  for (const CaseResult& item : cases) sum += item.tally;
  return sum;
}

ClassTally VerifyResult::total() const {
  ClassTally sum;
  for (const JobResult& job : jobs) sum += job.tally();
  return sum;
}

std::uint64_t VerifyResult::covered() const {
  std::uint64_t sum = 0;
  for (const JobResult& job : jobs) {
    for (const CaseResult& item : job.cases) sum += item.covered;
  }
  return sum;
}

std::size_t VerifyResult::skipped_cases() const {
  std::size_t count = 0;
  for (const JobResult& job : jobs) {
    for (const CaseResult& item : job.cases) count += item.skipped.empty() ? 0 : 1;
  }
  return count;
}

Verdict verdict(const VerifyResult& result) {
  const ClassTally total = result.total();
  if (total.unexplained > 0) return Verdict::failed;
  if (total.texels == 0 || result.covered() == 0 || result.skipped_cases() > 0) return Verdict::not_compared;
  return Verdict::agreed;
}

std::string to_string(Verdict value) {
  switch (value) {
    case Verdict::agreed: return "agreed";
    case Verdict::not_compared: return "not_compared";
    case Verdict::failed: return "failed";
  }
  return "";
}

}  // namespace etalon::validation
