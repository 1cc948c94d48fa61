# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
# Every library comes from the system; nothing is fetched at configure time.
# The Debian packages are listed in scripts/debian-packages.txt.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(assimp 5 REQUIRED)
find_package(embree 3 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
find_path(EIGENGRASP_HNSWLIB hnswlib/hnswlib.h REQUIRED)
find_package(Boost 1.74 REQUIRED)  # headers: Beast, Asio
find_package(LibArchive 3.6 REQUIRED)
find_package(PNG REQUIRED)
find_package(Coin REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(tinyxml2 REQUIRED IMPORTED_TARGET tinyxml2)
pkg_check_modules(qhull_r REQUIRED IMPORTED_TARGET qhull_r)
pkg_check_modules(liblzf REQUIRED IMPORTED_TARGET liblzf)
pkg_check_modules(sqlite3 REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(libpq REQUIRED IMPORTED_TARGET libpq)
if(EIGENGRASP_DEVELOPER)
  find_package(GTest REQUIRED)
  find_package(benchmark REQUIRED)
  pkg_check_modules(fcl REQUIRED IMPORTED_TARGET fcl)         # oracle of the collision tests
  pkg_check_modules(urdfdom REQUIRED IMPORTED_TARGET urdfdom)  # oracle of the URDF reader
endif()
