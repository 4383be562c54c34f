gnomon_test(job_file_test LABEL unit
  SOURCES job_file_test.cpp job_hostile_test.cpp job_keys_test.cpp job_layers_test.cpp
    job_sweep_test.cpp sweep_refusals_test.cpp sweep_space_test.cpp
  LINK gnomon::scene fmt::fmt)
target_compile_definitions(job_file_test PRIVATE
  GNOMON_EXAMPLES_FOLDER="${PROJECT_SOURCE_DIR}/examples")
