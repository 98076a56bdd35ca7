// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scenes.hpp"

#include <string_view>

namespace qwsm::test {
namespace {

constexpr double kCell_m = 0.5;
constexpr double kTableLeg_m = 0.04;

constexpr std::string_view kRoom = R"(
####################
#            ##    #
#     4  3   ##    #
#                  #
#o o               #
#           2    ###
#o o             ###
#                  #
#                  #
#                  #
#     ####     1   #
#     ####         #
#                  #
#   5        6     #
#                  #
####################
)";

constexpr std::string_view kPark = R"(
                      o             o

                   5

        6        o             4

    o       o
                              o


o                       o
                   o              3    o
     7


                                o
  o
                    o
                o          o
         8                       2
             9
      o       1
o                                    o
                               o
)";

constexpr std::string_view kTwoRooms = R"(
##################                    ##################
#                #                    #   ##           #
#  o o      ##   #                    #   ##           #
#           ##   #                    #       6    o o #
#        1       #                    #                #
#                ######################            o o #
#        b       #                    #                #
#                                                      #
#   2         4                          5          7  #
#             a                          9             #
#                #                    #                #
#                ######################       8        #
#   ###          #                    #        ####    #
#   ###   3      #                    #        ####    #
#                #                    #                #
##################                    ##################
)";

constexpr std::string_view kOffices = R"(
########################################################################
#       #        #      #         #         #       #      #      #    #
#       #        #      #         #         #       #      #      #    #
#       #        #      #         #    ###  #       #  ### #      #    #
#  o o  #   o o  # o o  #   ###   #         #   ### #      #  ### #    #
#       #        #      #         #         #       #      #      #    #
#       #        #      #         #         #       #      #      #    #
#       #        #      #         #         #       #      #      #    #
#       ##  #######  ######  ###########  #######  ####  #######       #
#       #                     #                                #       #
#       #           1                                                  #
#   o   # 5        6                    7                   2      o   #
#       #                                                      #       #
#       #    ###  ###################################  ####    #       #
#            #         #         #              #         #    #########
#            #         #         #              #         #    #       #
#       #    #         #         #              #         #    #       #
#########    #         #         #              #         #    #       #
#       #    #         #         #              #         #            #
#   o   #    #   o     #         #              # o  o    #            #
#            #         #       o #              #         #   ##  o    #
#            #         #         #              #         #    #       #
#       #    #         #      o  #              #         #    #########
#########    #     o   #         # o     o      #         #    #       #
#       #    #         #         #              #         #    #   o   #
#       #    #         #         #              #         #            #
#       #    #         #         #              #         #            #
#   o   #    #         #         #              #         #    #       #
#       #    #         #         #              #         #    #########
#       #    #         #         #              #         #    #       #
#       #    ######  ########  #######  #############  ####       o    #
#                                                                      #
#                                                            3 #       #
#       #  4                                                   #       #
#       #                                #                     #       #
#       #####  ####  #####  ####   ########  ######   ##########       #
#        #      #      #      #         #        #          #          #
#        #      #      #      #         #        #          #          #
#        #  o o #      #      #   ###   # ###    #          #          #
#    ### #      #  o o # ###  #         #        #   ###    #   o o    #
#        #      #      #      #         #        #          #          #
#        #      #      #      #         #        #          #          #
#        #      #      #      #         #        #          #          #
########################################################################
)";

}  // namespace

Scene FurnishedRoom() {
  return Moved(SceneFromDrawing(kRoom, kCell_m, kTableLeg_m), {4.0, 1.0, 0.25});
}

Scene TwoRoomsAndCorridor() {
  return Moved(SceneFromDrawing(kTwoRooms, kCell_m, kTableLeg_m), {3.0, -7.0, 0.3});
}

Scene LongCorridor() {
  const std::vector<Eigen::Vector2d> corridor_m = {{0, 0},
                                                   {60, 0},
                                                   {60, 2},
                                                   {31, 2},
                                                   {31, 5},
                                                   {28, 5},
                                                   {28, 2.1},
                                                   {30, 2.1},
                                                   {30, 2},
                                                   {0, 2},
                                                   {0, 0}};
  Scene scene{.world = {}, .route_m = {{2, 1}, {58, 1.2}, {2, 0.8}}};
  for (std::size_t i = 1; i < corridor_m.size(); ++i) {
    scene.world.walls.push_back({.from_m = corridor_m[i - 1], .to_m = corridor_m[i]});
  }
  return Moved(scene, {-5.0, 12.0, -0.4});
}

Scene Park() {
  constexpr double kParkCell_m = 1.2;
  constexpr double kTrunk_m = 0.2;
  return Moved(SceneFromDrawing(kPark, kParkCell_m, kTrunk_m), {-10.0, -10.0, 0.1});
}

Scene OfficeLoop() {
  return Moved(SceneFromDrawing(kOffices, kCell_m, kTableLeg_m), {-20.0, 4.0, 0.2});
}

}  // namespace qwsm::test
