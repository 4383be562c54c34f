#include "analysis/results/metric_table.hpp"

namespace gnomon::analysis {

const CurveMetrics& map_metrics()
{
    static const CurveMetrics metrics = describe_map_metrics();
    return metrics;
}

const ConfigurationMetrics& configuration_metrics()
{
    static const ConfigurationMetrics metrics = describe_configuration_metrics();
    return metrics;
}

const CurveMetrics& curve_metrics()
{
    static const CurveMetrics metrics = describe_curve_metrics();
    return metrics;
}

const std::vector<MetricDescription>& metric_descriptions()
{
    static const std::vector<MetricDescription> descriptions = [] {
        std::vector<MetricDescription> all;
        all.insert(all.end(), map_metrics().begin(), map_metrics().end());
        all.insert(all.end(), configuration_metrics().begin(), configuration_metrics().end());
        all.insert(all.end(), curve_metrics().begin(), curve_metrics().end());
        return all;
    }();
    return descriptions;
}

} // namespace gnomon::analysis
