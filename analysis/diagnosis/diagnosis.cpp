#include "analysis/diagnosis/diagnosis.hpp"

namespace gnomon::analysis {

Softening Diagnosis::left_out() const
{
    const Softening own{causes.amounts.shadow_softening, causes.amounts.light_softening};
    return curve.softening_at_zero ? analysis::left_out(own, *curve.softening_at_zero) : own;
}

} // namespace gnomon::analysis
