# Installs insonify to a fresh prefix, then uses it there: projects outside this build find the library, the command line
# runs a shipped scene, and nothing has a search path that it should not have.
#   BUILD_DIR        a built tree of insonify
#   SOURCE_DIR       its sources: a static library is made of its object files first, in WORK_DIR/static
#   UNITY            what CMAKE_UNITY_BUILD was for them
#   PACKAGES         ON: by way of Debian packages, unpacked in WORK_DIR/root
#   HARDENED         ON: the build has what cmake/Hardening.cmake gives
#   WORK_DIR         where to do all this
#   COMPILER         C++ compiler
#   PYTHON           Python 3
#   WITH_PYTHON      ON: the Python package was built
#   WITH_SDF         not empty: SDF files can be read
#   BRIDGES          how many programs of bridges were built
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${prefix} ${WORK_DIR}/staged ${WORK_DIR}/consumer ${WORK_DIR}/examples ${WORK_DIR}/root ${WORK_DIR}/packages ${WORK_DIR}/other)
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output ${output} PARENT_SCOPE)
endfunction()
# build_project(NAME SOURCES): a project of somebody else's, who has insonify installed, in WORK_DIR/NAME; not optimised, which
# is compiled sooner.
function(build_project name sources)
  run(${CMAKE_COMMAND} -G Ninja -S ${sources} -B ${WORK_DIR}/${name} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0
      -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/${name})
endfunction()

if(SOURCE_DIR)
  # Takes the same object files: to compile everything once more would take minutes.
  set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "${CMAKE_CURRENT_LIST_DIR}/take_object.sh;${BUILD_DIR}")
  set(BUILD_DIR ${WORK_DIR}/static)
  file(REMOVE_RECURSE ${BUILD_DIR}/CMakeFiles/insonify.dir ${BUILD_DIR}/CMakeFiles/insonify_reader.dir ${BUILD_DIR}/CMakeFiles/insonify_sdf_objects.dir)  # Objects taken know nothing of headers that have changed.
  run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE_DIR} -B ${BUILD_DIR} -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_CXX_COMPILER=${COMPILER} -DBUILD_SHARED_LIBS=OFF -DCMAKE_UNITY_BUILD=${UNITY}
      -DINSONIFY_BUILD_TESTS=OFF -DINSONIFY_BUILD_APPS=OFF)
  run(${CMAKE_COMMAND} --build ${BUILD_DIR})
  unset(ENV{CMAKE_CXX_COMPILER_LAUNCHER})
endif()

if(PACKAGES)
  # gzip: xz, which they are published with, takes 15 s more.
  run(cpack --config ${BUILD_DIR}/CPackConfig.cmake -B ${WORK_DIR}/packages -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip)
  file(GLOB packages ${WORK_DIR}/packages/*.deb)
  list(LENGTH packages count)
  math(EXPR expected "3 + ${BRIDGES}")
  if(WITH_PYTHON)
    math(EXPR expected "${expected} + 1")
  endif()
  if(NOT count EQUAL expected)
    message(FATAL_ERROR "There should be ${expected} packages, and there are: ${packages}")
  endif()
  foreach(package IN LISTS packages)
    run(dpkg-deb --extract ${package} ${WORK_DIR}/root)
    run(dpkg-deb --field ${package} Package Depends)
    message("${output}")
    string(APPEND depends "${output}")
  endforeach()
  if(WITH_PYTHON)
    set(of_python "python3-numpy")
  endif()
  if(WITH_SDF)
    set(of_sdf "libsdformat")
  endif()
  foreach(needed "libembree[34]" ${of_sdf} "libhdf5" "libeigen3-dev" "libinsonify[0-9.]+ \\(= " ${of_python})
    if(NOT depends MATCHES "${needed}")
      message(FATAL_ERROR "No package depends on ${needed}")
    endif()
  endforeach()
  set(prefix ${WORK_DIR}/root/usr)
else()
  # Moved after the installation, which must not matter.
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/staged)
  set(installed "${output}")
  file(RENAME ${WORK_DIR}/staged ${prefix})
endif()

build_project(consumer ${CMAKE_CURRENT_LIST_DIR})
if(SOURCE_DIR)  # The program was moved after the installation, and a static library does not know where to.
  set(reader ${CMAKE_COMMAND} -E env INSONIFY_READER=${prefix}/libexec/insonify/insonify-read)
endif()
run(${reader} ${WORK_DIR}/consumer/consumer ${WORK_DIR}/ping.h5)
message("${output}")
# A program that the static library is a part of does not know where that was installed.
if(NOT SOURCE_DIR AND NOT output MATCHES "preset from ${prefix}/share/insonify/presets/tritech-micron-dst.yaml")
  message(FATAL_ERROR "The presets installed in ${prefix} were not used")
endif()

# The same by pkg-config, where a shared library is installed and its own packages are known to it.
file(GLOB_RECURSE pkgconfig ${prefix}/lib*/insonify.pc)
find_program(pkg_config pkg-config)
if(pkgconfig AND pkg_config)
  cmake_path(GET pkgconfig PARENT_PATH pkgconfig_folder)
  run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pkgconfig_folder} ${pkg_config} --cflags --libs insonify)
  separate_arguments(flags UNIX_COMMAND "${output}")
  run(${COMPILER} ${CMAKE_CURRENT_LIST_DIR}/by_pkgconfig.cpp -o ${WORK_DIR}/by_pkgconfig ${flags})
  cmake_path(GET pkgconfig_folder PARENT_PATH library_folder)
  run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${library_folder} ${WORK_DIR}/by_pkgconfig)
elseif(NOT SOURCE_DIR AND NOT pkgconfig)
  message(FATAL_ERROR "insonify.pc was not installed")
endif()

if(EXISTS ${prefix}/bin/insonify)
  set(cli ${prefix}/bin/insonify)
  run(${cli} version)
  run(${cli} run ${prefix}/share/insonify/scenes/car.yaml -o ${WORK_DIR}/out --pings 1 --no-pictures --force)
  foreach(file share/man/man1/insonify.1 share/bash-completion/completions/insonify
      share/zsh/site-functions/_insonify share/fish/vendor_completions.d/insonify.fish)
    if(NOT EXISTS ${prefix}/${file})
      message(FATAL_ERROR "${file} was not installed")
    endif()
  endforeach()

  file(GLOB libraries ${prefix}/lib*/libinsonify*.so.*.*.* ${prefix}/lib/*/libinsonify*.so.*.*.*)
  if(HARDENED)
    set(hardened --hardened)
  endif()
  run(${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/linkage_test.py ${hardened} ${cli} ${libraries} ${prefix}/libexec/insonify/insonify-read)
  message("${output}")

  if(NOT PACKAGES)
    build_project(examples ${prefix}/share/insonify/examples)
    run(${WORK_DIR}/examples/first_ping ${prefix}/share/insonify/scenes/sphere.yaml)
    message("${output}")
    run(${WORK_DIR}/examples/own_scene ${WORK_DIR})
    message("${output}")
    run(${WORK_DIR}/examples/approaching_object)
    message("${output}")
  endif()
endif()

# The Python package lies where the Python of that prefix looks, and makes a ping there.
if(WITH_PYTHON)
  if(PACKAGES)
    set(packages ${prefix}/lib/python3/dist-packages)
  else()
    file(GLOB packages ${prefix}/lib/python3.*/site-packages)
    if(NOT installed MATCHES "export PYTHONPATH=${WORK_DIR}/staged/lib/python3.[0-9]+/site-packages")
      message(FATAL_ERROR "How Python finds the package was not printed:\n${installed}")
    endif()
  endif()
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${packages} PYTHONDONTWRITEBYTECODE=1 LD_LIBRARY_PATH= ${PYTHON} -c "
import importlib.metadata, pathlib, insonify
assert pathlib.Path(insonify.__file__).parent.parent == pathlib.Path('${packages}'), insonify.__file__
assert importlib.metadata.version('insonify') == insonify.__version__
folder = pathlib.Path(insonify.__file__).parent
assert (folder / 'py.typed').exists() and (folder / '_insonify/__init__.pyi').exists()
assert 'tritech-gemini-720i' in insonify.preset_names()
scenario = insonify.Scenario.from_dict({'world': 'none', 'sonars': [{'max_range': 9, 'beam_count': 32, 'bin_count': 90}]})
scene = insonify.Scene()
scene.add('wall', [[6, -4, -4], [6, 4, -4], [6, 4, 4], [6, -4, 4]], [[0, 1, 2], [0, 2, 3]], material='concrete')
ping = insonify.Simulator(scenario, scene).ping()
assert (ping.instance == 0).any()
print('A ping of', *ping.shape, 'from Python', insonify.__version__)
")
  message("${output}")
  # Other prefixes: what cmake --install and a distribution would do.
  if(NOT PACKAGES AND BUILD_DIR)
    foreach(place "usr:lib/python3/dist-packages" "usr/local:lib/python3.*/dist-packages")
      string(REPLACE ":" ";" place ${place})
      list(GET place 0 below)
      list(GET place 1 expected)
      run(${CMAKE_COMMAND} --install ${BUILD_DIR} --component python --prefix ${WORK_DIR}/other/${below})
      file(GLOB found ${WORK_DIR}/other/${below}/${expected}/insonify/__init__.py)
      if(NOT found)
        message(FATAL_ERROR "The Python package is not in ${below}/${expected}")
      endif()
    endforeach()
  endif()
endif()
