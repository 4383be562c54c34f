#include "example_page.hpp"

#include "example_run.hpp"
#include "reports/json/comparison_json.hpp"
#include "store/exr/aov_write.hpp"
#include "store/output_file.hpp"
#include "store/run/run_store.hpp"
#include "store/run_folder/pixels.hpp"

#include <string>

namespace gnomon::reports {

ReadPage written_page(const std::filesystem::path& run, const std::filesystem::path& out,
                      std::size_t most_image_bytes)
{
    std::filesystem::create_directories(out);
    write_report_csv(run, out);
    write_report({run, out, {}, "python3-matplotlib is missing", {}, most_image_bytes});
    return ReadPage{store::read_text(out / "report.html")};
}

void keep_example(const std::filesystem::path& folder, const analysis::Comparison& comparison)
{
    store::ExampleRun run;
    run.curves = 1;
    run.biases = 1;
    store::RunDescription description = run.description();
    description.axes = {};
    std::filesystem::create_directories(folder);
    store::RunStore store{folder, store::RunStore::Access::write};
    store.plan(description, run.configurations());
    analysis::FinishedCurve curve = run.curve(0);
    curve.rows.front().result.metrics = comparison.metrics;
    store.record(curve);
    const std::string id = run.configurations().front().id;
    store::make_pixels_folder(folder);
    store::write_file(store::detail_path(folder, id), comparison_json(comparison));
    store::write_aov(store::pixels_path(folder, id), comparison, store::example().points);
}

} // namespace gnomon::reports
