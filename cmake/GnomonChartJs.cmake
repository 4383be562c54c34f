# Chart.js draws the charts of report.html. It is Debian's libjs-chart.js under the MIT licence, which the file, and so every
# page, contains. The hash fixes its version. Without it everything builds, and pages say that the charts are missing.
set(chart_js_sha256 fbc45926e6b46845a0f905552a0e0b1331049bff1115ecf94dbe0904d895e710) # 3.9.1
find_file(GNOMON_CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js
          DOC "Chart.js 3.9.1, chart.min.js")
if(NOT GNOMON_CHART_JS)
  set(GNOMON_CHART_JS "")
  message(WARNING "Chart.js is missing: reports have no charts; install libjs-chart.js")
else()
  file(SHA256 ${GNOMON_CHART_JS} found_sha256)
  if(NOT found_sha256 STREQUAL chart_js_sha256)
    set(GNOMON_CHART_JS "")
    message(WARNING "Chart.js is not the version that was tested, 3.9.1: reports have no charts")
  endif()
endif()
