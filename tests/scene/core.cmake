gnomon_test(scene_driver_bound_test LABEL unit
  SOURCES driver_bound_test.cpp
  LINK gnomon::scene)
