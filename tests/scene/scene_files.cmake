gnomon_test(scene_files_test LABEL unit
  SOURCES
    case_file_test.cpp
    import_process_test.cpp
    scene_file_test.cpp
    scene_file_hostile_test.cpp
    scene_file_models_test.cpp
  LINK gnomon::scene fmt::fmt)
