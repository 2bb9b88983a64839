# find_package(kreisel): the target kreisel::kreisel. Public headers use Eigen and nothing else.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
include(${CMAKE_CURRENT_LIST_DIR}/kreiselTargets.cmake)
