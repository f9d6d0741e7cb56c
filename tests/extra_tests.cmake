# Tests that are no GoogleTest programs.

# Data flows one way: a file includes its own module and those to its left.
add_test(NAME include_directions
  COMMAND Python3::Interpreter tools/check_includes.py WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})

# Types of one name are of one kind.
add_test(NAME type_names
  COMMAND Python3::Interpreter tools/check_names.py include src apps python/src WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})

# Functions fit on a screen.
add_test(NAME function_lengths
  COMMAND Python3::Interpreter tools/check_functions.py src
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
add_test(NAME function_lengths_counted
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/tools/check_functions_test.py)

# The formulas of echoes are GLSL too.
add_test(NAME laws_in_shaders
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/echo/laws_in_shaders_test.py ${PROJECT_SOURCE_DIR})
set_tests_properties(laws_in_shaders PROPERTIES SKIP_RETURN_CODE 77)

# Each public header can be included first.
add_test(NAME headers_stand_alone
  COMMAND Python3::Interpreter tools/check_headers.py ${CMAKE_CURRENT_BINARY_DIR}/headers ${CMAKE_CXX_COMPILER} -std=c++20 -Wall
          "-I$<JOIN:$<TARGET_PROPERTY:insonify,INTERFACE_INCLUDE_DIRECTORIES>,;-I>"
          "-isystem;$<JOIN:$<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>,;-isystem;>"
  COMMAND_EXPAND_LISTS WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(headers_stand_alone PROPERTIES PROCESSORS 2)

# The Python package, as a program of Python sees it. A sanitized module would need the sanitizer in Python itself.
if(TARGET insonify_python AND NOT INSONIFY_SANITIZE)
  add_test(NAME python_package
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/python/package_test.py $<TARGET_FILE:insonify_cli> ${PROJECT_SOURCE_DIR})
  add_test(NAME python_types
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/python/types_test.py ${PROJECT_SOURCE_DIR})
  set(python_tests python_package python_types)
  foreach(name config recording layers plot acoustics compare same_bytes mistakes mcap_input unfinished pickle message_options from_dict pose_forms arguments survey line soundings end)
    add_test(NAME python_${name}
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/python/${name}_test.py $<TARGET_FILE:insonify_cli> ${PROJECT_SOURCE_DIR})
    list(APPEND python_tests python_${name})
  endforeach()
  foreach(example first_ping fly_a_square dataset gym_environment point_cloud pictures mosaic speed)
    add_test(NAME python_examples.${example}
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/python/examples_test.py ${example} ${PROJECT_SOURCE_DIR})
    list(APPEND python_tests python_examples.${example})
  endforeach()
  # A line of a real side-scan sonar beside a simulated one.
  add_test(NAME wreck_line COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/validation/wreck_line.py)
  # Soundings of real sea floors.
  add_test(NAME error_budget COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/validation/error_budget.py --pings 10)
  list(APPEND python_tests wreck_line error_budget)
  set_tests_properties(${python_tests} PROPERTIES ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1"
    SKIP_RETURN_CODE 77)
endif()

# Search paths of what was built, and what guards it.
if(INSONIFY_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL Debug)
  set(hardened OFF)
else()
  set(hardened ON)
endif()
# Not by generator expressions: from CMake 3.31 on an empty one is an empty word.
set(hardened_option)
if(hardened)
  set(hardened_option --hardened)
endif()
set(folder_of_module)
if(TARGET insonify_python)
  set(folder_of_module $<TARGET_FILE_DIR:insonify_python>)
endif()
add_test(NAME linkage
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/install/linkage_test.py ${hardened_option}
          $<TARGET_FILE:insonify> $<TARGET_FILE_DIR:insonify> $<TARGET_FILE_DIR:insonify_cli> $<TARGET_FILE_DIR:insonify_reader>
          ${folder_of_module})
# The reader of SDF is opened at the first SDF file, and where it is absent a line says so.
if(TARGET insonify_sdf AND NOT INSONIFY_SANITIZE)
  add_test(NAME sdf_library
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/install/sdf_library_test.py $<TARGET_FILE:insonify_cli>
            $<TARGET_FILE:insonify> $<TARGET_SONAME_FILE_NAME:insonify> ${PROJECT_SOURCE_DIR}/scenes/sphere.yaml)
endif()
# A library that lies in the current folder is not run.
add_test(NAME planted_library
  COMMAND sh -c "mkdir -p planted && cd planted && touch libfreetype.so.6 libembree3.so.3 libsdformat12.so.12 && $1 version"
          planted_library $<TARGET_FILE:insonify_cli>)

# A project outside this build can find and use an installed copy ...
function(insonify_install_test name)
  add_test(NAME ${name}
    COMMAND ${CMAKE_COMMAND} ${ARGN} -DCOMPILER=${CMAKE_CXX_COMPILER} -DPYTHON=${Python3_EXECUTABLE}
            -DHARDENED=${hardened} -DWORK_DIR=${CMAKE_CURRENT_BINARY_DIR}/${name}
            -P ${CMAKE_CURRENT_SOURCE_DIR}/install/run.cmake)
endfunction()
set(with_python OFF)
if(TARGET insonify_python)
  set(with_python $<NOT:$<BOOL:${INSONIFY_SANITIZE}>>)
endif()
insonify_install_test(install_and_use -DBUILD_DIR=${PROJECT_BINARY_DIR} -DWITH_PYTHON=${with_python})
if(CMAKE_BUILD_TYPE STREQUAL Release AND NOT INSONIFY_SANITIZE)
  # ... by way of packages too, where there is what makes them ...
  find_program(dpkg_shlibdeps dpkg-shlibdeps)
  find_program(file_program file)
  if(dpkg_shlibdeps AND file_program)
    set(bridge_count 0)
    foreach(bridge ros1 dds gazebo)
      if(TARGET insonify_bridge_${bridge})
        math(EXPR bridge_count "${bridge_count} + 1")
      endif()
    endforeach()
    insonify_install_test(package_and_use -DBUILD_DIR=${PROJECT_BINARY_DIR} -DPACKAGES=ON -DWITH_PYTHON=${with_python}
      -DWITH_SDF=${INSONIFY_SDFORMAT} -DBRIDGES=${bridge_count})
  endif()
  # ... and of the static library.
  insonify_install_test(install_and_use_static -DUNITY=$<BOOL:${CMAKE_UNITY_BUILD}> -DBUILD_DIR=${PROJECT_BINARY_DIR} -DSOURCE_DIR=${PROJECT_SOURCE_DIR})
endif()

# What puts wheels together; `./dev wheel --test` tries whole ones.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64 AND Python3_VERSION VERSION_GREATER_EQUAL 3.11)
  add_test(NAME wheel_parts COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/install/wheel_test.py)
  set_tests_properties(wheel_parts PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
endif()

# Damaged files of all formats, requests and frames: a few of what `./dev fuzz` tries.
if(INSONIFY_BUILD_APPS)
  set(unlimited)
  if(INSONIFY_SANITIZE)
    set(unlimited --unlimited)
  endif()
  add_test(NAME damaged_inputs
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/damaged_inputs.py $<TARGET_FILE:insonify_cli> --count 150 ${unlimited})
  add_test(NAME serve_frames
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/serve_frames.py $<TARGET_FILE:insonify_cli>)
  if(TARGET failing_calls)
    add_test(NAME failing_calls
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/failing_calls.py $<TARGET_FILE:insonify_cli>
              $<TARGET_FILE:failing_calls> --count 16)
  endif()
  set_tests_properties(damaged_inputs serve_frames PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
endif()

# What the documentation shows is what happens: every code block runs (tools/run_doc_blocks.py).
if(BUILD_SHARED_LIBS)
  string(JOIN " " compile ${CMAKE_CXX_COMPILER} -std=c++20
    "-I$<JOIN:$<TARGET_PROPERTY:insonify,INTERFACE_INCLUDE_DIRECTORIES>, -I>"
    "-isystem $<JOIN:$<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>, -isystem >")
  string(JOIN " " link $<TARGET_FILE:insonify> -Wl,-rpath,$<TARGET_FILE_DIR:insonify>)
  if(INSONIFY_SANITIZE)
    string(APPEND compile " -fsanitize=${INSONIFY_SANITIZE}")
  endif()
  file(GLOB documents CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/README.md
    ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*/*.md
    ${PROJECT_SOURCE_DIR}/examples/python/*.ipynb)
  foreach(document IN LISTS documents)
    add_test(NAME documentation.${document}
      COMMAND Python3::Interpreter tools/run_doc_blocks.py --build ${PROJECT_BINARY_DIR} --compile=${compile}
              --link=${link} ${document}
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  endforeach()
endif()
add_test(NAME documentation_links
  COMMAND sh -c "$1 tools/check_links.py README.md CONTRIBUTING.md SECURITY.md CHANGELOG.md bench/README.md docs && $1 tests/tools/check_links_test.py && $1 tests/tools/make_site_test.py"
          documentation_links ${Python3_EXECUTABLE}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
add_test(NAME run_doc_blocks
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/tools/run_doc_blocks_test.py)

# Speckle, and how a seabed falls off, as real sonars have recorded them.
foreach(comparison oculus_statistics sidescan_falloff)
  add_test(NAME ${comparison}
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/validation/${comparison}.py $<TARGET_FILE:insonify_cli>
            ${CMAKE_CURRENT_BINARY_DIR}/${comparison})
  set_tests_properties(${comparison} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()

# What multipath leaves of the shadows of the shipped scenes.
add_test(NAME shadow_depth
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/validation/shadow_depth.py $<TARGET_FILE:insonify_cli> --check
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})

add_test(NAME shadow_depth_measures COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/validation/shadow_depth_test.py)

# Texts about the command line for shells and man.
add_test(NAME shell_texts
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/apps/shell_texts_test.py ${PROJECT_BINARY_DIR})

# Comments in the public headers are read without a warning.
find_program(doxygen doxygen)
if(doxygen AND NOT INSONIFY_SANITIZE)
  add_test(NAME api_pages COMMAND bash dev docs --headers WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endif()

# The version in CMakeLists.txt is the newest of the changelog, and the one to cite.
add_test(NAME version_is_told_alike
  COMMAND sh -c "grep -m 1 '^## \\[[0-9]' CHANGELOG.md | grep -F '[${PROJECT_VERSION}]' && grep -Fx 'version: ${PROJECT_VERSION}' CITATION.cff"
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})

# The package for ROS 2, as far as it goes without ROS 2, and the layout for Foxglove.
if(INSONIFY_BUILD_APPS)
  add_test(NAME ros2_package
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/bridges/ros2_package_test.py $<TARGET_FILE:insonify_cli> ${PROJECT_VERSION})
  set_tests_properties(ros2_package PROPERTIES SKIP_RETURN_CODE 77)
  add_test(NAME ros2_type_hashes
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/bridges/type_hash_test.py $<TARGET_FILE:insonify_cli>)
endif()

# MCAP recordings as the libraries of npm read them.
if(INSONIFY_BUILD_APPS)
  set(node_folder ${PROJECT_BINARY_DIR}/tests/node)
  add_test(NAME node_packages
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/node/install.py ${node_folder})
  set_tests_properties(node_packages PROPERTIES FIXTURES_SETUP node_packages SKIP_RETURN_CODE 77)
  add_test(NAME mcap_readers
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/node/run.py ${node_folder} mcap_test.mjs
            $<TARGET_FILE:insonify_cli> ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/node/h5_json.py)
  set_tests_properties(mcap_readers PROPERTIES FIXTURES_REQUIRED node_packages SKIP_RETURN_CODE 77)
  add_test(NAME bag_readers
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/node/run.py ${node_folder} bag_test.mjs
            $<TARGET_FILE:insonify_cli> ${Python3_EXECUTABLE})
  set_tests_properties(bag_readers PROPERTIES FIXTURES_REQUIRED node_packages SKIP_RETURN_CODE 77)
  # The channels of `insonify serve` as Foxglove's client reads them.
  add_test(NAME foxglove_client
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/node/run.py ${node_folder} foxglove_test.mjs
            $<TARGET_FILE:insonify_cli>)
  set_tests_properties(foxglove_client PROPERTIES FIXTURES_REQUIRED node_packages SKIP_RETURN_CODE 77 TIMEOUT 120)
  # What the viewer's page computes, without a browser.
  add_test(NAME viewer_logic
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/node/run.py ${node_folder} web/logic_test.mjs)
  set_tests_properties(viewer_logic PROPERTIES FIXTURES_REQUIRED node_packages SKIP_RETURN_CODE 77)
  # The viewer in a headless browser: its page against a stand-in for the server, and with `insonify serve`.
  if(NOT INSONIFY_SANITIZE)
    add_test(NAME viewer_page
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/node/run.py ${node_folder} web/page_test.mjs)
    add_test(NAME viewer_live
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/node/run.py ${node_folder} web/live_test.mjs
              $<TARGET_FILE:insonify_cli>)
    set_tests_properties(viewer_page viewer_live PROPERTIES
      FIXTURES_REQUIRED node_packages SKIP_RETURN_CODE 77 TIMEOUT 900 COST 1000 RESOURCE_LOCK browser)
    # They measure times and rates, whose limits follow the machine's load (tests/web/checks.mjs): others may run beside them,
    # but not both, since the processor draws for Chromium.
  endif()
  # `insonify serve` against hostile and unlucky clients.
  if(NOT INSONIFY_SANITIZE)
    foreach(name serve serve_slow serve_starting)
      add_test(NAME ${name}
        COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/apps/${name}_test.py $<TARGET_FILE:insonify_cli>)
      set_tests_properties(${name} PROPERTIES TIMEOUT 300 COST 1000)  # They wait most of the time: others run beside them.
    endforeach()
    # `insonify replay --view`.
    add_test(NAME replay_view
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/apps/replay_view_test.py $<TARGET_FILE:insonify_cli>)
    set_tests_properties(replay_view PROPERTIES TIMEOUT 120 SKIP_RETURN_CODE 77)
  endif()
  # Files of side-scan sonars, field by field.
  add_test(NAME side_scan_files
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/apps/side_scan_files_test.py $<TARGET_FILE:insonify_cli>)
  set_tests_properties(side_scan_files PROPERTIES TIMEOUT 120)
  add_test(NAME multibeam_files
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/apps/multibeam_files_test.py $<TARGET_FILE:insonify_cli>)
  set_tests_properties(multibeam_files PROPERTIES TIMEOUT 120)
  add_test(NAME sounding_messages
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/apps/sounding_messages_test.py $<TARGET_FILE:insonify_cli>)
  set_tests_properties(sounding_messages PROPERTIES TIMEOUT 120)
  # Charts of soundings.
  add_test(NAME grid_command
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/apps/grid_test.py $<TARGET_FILE:insonify_cli>)
  set_tests_properties(grid_command PROPERTIES TIMEOUT 240)
  # Emulated instruments as a driver meets them.
  foreach(test oculus oculus_clients ping360 ping_streamers sonar3d15)
    add_test(NAME emulate_${test}
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/apps/${test}_test.py $<TARGET_FILE:insonify_cli>)
    set_tests_properties(emulate_${test} PROPERTIES TIMEOUT 120)
  endforeach()
  foreach(instrument oculus ping360)
    # A vehicle that follows a wall, as a client of the instrument sees it; for a minute by hand.
    add_test(NAME follow_wall_${instrument}
      COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/bench/follow_wall.py ${instrument} $<TARGET_FILE:insonify_cli> --seconds 3 --slowest 0)
    set_tests_properties(follow_wall_${instrument} PROPERTIES TIMEOUT 120)
  endforeach()
  # NumPy archives and Zarr groups as NumPy and zarr read them.
  add_test(NAME exported_arrays
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/python/export_test.py $<TARGET_FILE:insonify_cli>)
  set_tests_properties(exported_arrays PROPERTIES SKIP_RETURN_CODE 77)
endif()
# The node of ROS 1 with a roscore of its own.
if(NOT INSONIFY_SANITIZE)
  foreach(subject recording soundings settings roscore poses ping_service)
    add_test(NAME ros1_${subject}
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/bridges/ros1/${subject}_test.py $<TARGET_FILE:insonify_cli>)
    set_tests_properties(ros1_${subject} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
  endforeach()
  add_test(NAME ros1_launch
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/bridges/ros1/launch_test.py $<TARGET_FILE:insonify_cli> ${PROJECT_VERSION})
  set_tests_properties(ros1_launch PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
  add_test(NAME follow_wall_ros1
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/bench/follow_wall.py ros1 $<TARGET_FILE:insonify_cli> --seconds 4 --slowest 0)
  set_tests_properties(follow_wall_ros1 PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 120)
endif()
