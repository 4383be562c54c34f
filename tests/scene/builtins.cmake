gnomon_test(builtin_scenes_test LABEL unit
  SOURCES builtin_scenes_test.cpp builtin_geometry_test.cpp mesh_checks.cpp
  LINK gnomon::scene glm::glm)
# The property tests draw the same cases in every run.
set_tests_properties(builtin_scenes_test PROPERTIES ENVIRONMENT RC_PARAMS=seed=20250401)
