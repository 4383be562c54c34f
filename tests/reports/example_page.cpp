#include "example_page.hpp"

#include "example_run.hpp"
#include "reports/aov_exr.hpp"
#include "reports/comparison_json.hpp"
#include "reports/output_file.hpp"
#include "reports/run/pixels.hpp"
#include "reports/run/run_store.hpp"

#include <string>

namespace gnomon::reports {

ReadPage written_page(const std::filesystem::path& run, const std::filesystem::path& out,
                      std::size_t most_image_bytes)
{
    std::filesystem::create_directories(out);
    write_report_csv(run, out);
    write_report({run, out, {}, "python3-matplotlib is missing", {}, most_image_bytes});
    return ReadPage{read_text(out / "report.html")};
}

void keep_example(const std::filesystem::path& folder, const analysis::Comparison& comparison)
{
    ExampleRun run;
    run.curves = 1;
    run.biases = 1;
    RunDescription description = run.description();
    description.axes = {};
    std::filesystem::create_directories(folder);
    RunStore store{folder, RunStore::Access::write};
    store.plan(description, run.configurations());
    analysis::FinishedCurve curve = run.curve(0);
    curve.rows.front().result.metrics = comparison.metrics;
    store.record(curve);
    const std::string id = run.configurations().front().id;
    make_pixels_folder(folder);
    write_file(detail_path(folder, id), comparison_json(comparison));
    write_aov(pixels_path(folder, id), comparison, example().points);
}

} // namespace gnomon::reports
