# Unity builds, with -DCMAKE_UNITY_BUILD=ON: several sources are compiled as one file, which shortens a clean build.
# Only files of one folder are compiled together. So a name in an anonymous namespace must be unique in its folder.

# bindpose_unity_groups(TARGET LARGEST): divide the sources of each folder into equal groups of at most LARGEST files.
function(bindpose_unity_groups target largest)
  get_target_property(sources ${target} SOURCES)
  get_target_property(target_folder ${target} SOURCE_DIR)
  list(FILTER sources INCLUDE REGEX "\\.(cpp|cxx)$")
  set(folders "")
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${target_folder}")
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    list(APPEND folders ${folder})
    list(APPEND sources_of_${folder} "${source}")
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    list(LENGTH sources_of_${folder} count)
    math(EXPR groups "(${count} + ${largest} - 1) / ${largest}")
    set(index 0)
    foreach(source IN LISTS sources_of_${folder})
      math(EXPR group "${index} * ${groups} / ${count}")
      set_source_files_properties("${source}" TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP "${folder}_${group}")
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  # In a group, every source is an included file, so this warning about headers would apply to it.
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
endfunction()

# Groups of kernels are small, so that a changed kernel can be built and tested in seconds.
bindpose_unity_groups(bindpose_core 4)
foreach(target IN ITEMS Filters Widgets bindpose_scene bindpose_document bindpose_poses bindpose_app bindpose_tour bindpose
    bindpose_benchmarks bindpose_test_support bindpose_core_tests bindpose_filter_tests bindpose_render_tests
    bindpose_scene_tests bindpose_widget_tests bindpose_poses_tests bindpose_document_tests bindpose_app_tests)
  if(TARGET ${target})
    bindpose_unity_groups(${target} 8)
  endif()
endforeach()
set_target_properties(bindpose-reader PROPERTIES UNITY_BUILD OFF)
if(TARGET bindpose-mesher)
  # A group of the sources with CGAL would need too much memory.
  set_target_properties(bindpose-mesher PROPERTIES UNITY_BUILD OFF)
endif()
