gnomon_test(scene_driver_bound_test LABEL unit
  SOURCES driver_bound_test.cpp
  LINK gnomon::scene)
gnomon_test(scene_core_test LABEL unit
  SOURCES
    camera_test.cpp
    depth_planes_test.cpp
    light_frustum_test.cpp
    light_test.cpp
    triangles_test.cpp
    view_test.cpp
  LINK gnomon::scene fmt::fmt)
