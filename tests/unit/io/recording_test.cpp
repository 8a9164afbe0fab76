// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <analytic_scene.hpp>
#include <temporary_folder.hpp>

#include <vantage/core/units.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/io/png.hpp>
#include <vantage/io/recording_aligned.hpp>
#include <vantage/io/recording_any.hpp>
#include <vantage/sim/replay_world.hpp>

namespace vantage {
namespace {

namespace fs = std::filesystem;

// Pictures of 2 x 2 px, as text; `first` is the top left value.
std::string colour(int first) { return concat("P3 2 2 255\n", first, " 0 0  0 255 0  0 0 255  51 102 153\n"); }
std::string depth(int first) { return concat("P2 2 2 65535\n", first, " 0 2000 65535\n"); }

class RecordingTest : public testing::Test {
 protected:
  void put(const std::string& name, std::string_view text) const {
    fs::create_directories((root / name).parent_path());
    folder.put(name, text);
  }
  // That `read` throws an Error whose text has all of these in it.
  template <class Read>
  static void refuses(Read&& read, std::initializer_list<std::string_view> named) {
    try {
      (void)read();
      FAIL();
    } catch (const Error& e) {
      for (const std::string_view name : named)
        EXPECT_NE(std::string_view(e.what()).find(name), std::string_view::npos) << name << " in: " << e.what();
    }
  }
  void refused(std::initializer_list<std::string_view> named) const {
    refuses([&] { return read_recording(root); }, named);
  }
  const test::TemporaryFolder folder;
  const fs::path root = folder.path();
};

// ---- plain folders

class FolderRecording : public RecordingTest {
 protected:
  FolderRecording() {
    put("camera.txt", "width 2\nheight 2\nfx 2\nfy 2.5\ncx 1\ncy 1.25\ndepth_unit_m 0.0005\n");
    put("poses.txt",
        "1 0 0 1  0 1 0 2  0 0 1 3  0 0 0 1\n0 0 1 4  -1 0 0 5  0 -1 0 6\n# the last\n1 0 0 7 0 1 0 8 0 0 1 9\n");
    for (const char* i : {"2", "9", "10"}) {
      put(concat("colour/", i, ".ppm"), colour(std::stoi(i)));
      put(concat("depth/", i, ".pgm"), depth(1000 * std::stoi(i)));
    }
    put("colour/readme.txt", "no picture");
  }
};

TEST_F(FolderRecording, ReadsCameraPosesAndPicturesInNaturalOrder) {
  const Recording r = read_recording(root);
  ASSERT_EQ(r.size(), 3U);
  EXPECT_EQ(r.frames()[0].camera.fy, 2.5);
  EXPECT_EQ(r.frames()[2].camera.cy, 1.25);
  const std::vector<int> number = {2, 9, 10};
  for (std::size_t i = 0; i < 3; ++i) {
    const Frame f = r.frame(i);
    f.validate("frame");
    EXPECT_EQ(f.colour.r(0, 0), static_cast<float>(number[i]) / 255);
    EXPECT_EQ(f.colour.b(1, 1), 0.6F);
    EXPECT_FLOAT_EQ(f.depth(0, 0), 0.5F * static_cast<float>(number[i]));
    EXPECT_TRUE(std::isnan(f.depth(0, 1)));
    EXPECT_FLOAT_EQ(f.depth(1, 1), 32.7675F);
    EXPECT_EQ(f.labels.size(), 0);
  }
  EXPECT_EQ(r.frames()[0].view.position(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(r.frames()[1].view.position(), Eigen::Vector3d(4, 5, 6));
  EXPECT_TRUE(r.frames()[1].view.forward().isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_THROW((void)r.frame(3), Error);
}

TEST_F(FolderRecording, ReadsLabelsAndDoesWithoutColour) {
  fs::remove_all(root / "colour");
  for (int i : {1, 2, 3}) put(concat("labels/", i, ".pgm"), concat("P2 2 2 255\n0 1 2 ", i));
  const Frame f = read_recording(root).frame(2);
  EXPECT_TRUE(f.colour.empty());
  EXPECT_EQ(f.labels(1, 1), 3);
  EXPECT_EQ(f.labels(0, 0), 0);
}

TEST_F(FolderRecording, ItsPicturesAreAPoolOfTheirOwnViews) {
  const Recording r = read_recording(root);
  ReplayWorld world(r.views(), [&](std::size_t i) { return r.frame(i); });
  const auto frame = world.observe(world.views()[2]);
  ASSERT_TRUE(frame);
  EXPECT_FLOAT_EQ(frame->depth(0, 0), 5.0F);
}

TEST_F(FolderRecording, RoundedRotationsAreMadeRotations) {
  put("poses.txt",
      "0.8660 -0.5 0 0 0.5 0.8660 0 0 0 0 1 0\n0.866 -0.5 0 0 0.5 0.866 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
  const Recording r = read_recording(root);
  for (const View& v : r.views()) check_view(v, "view");
  EXPECT_NEAR(r.views()[0].T_W_C.linear()(0, 0), std::cos(deg(30)), 1e-5);
}

TEST_F(FolderRecording, NamesWhatIsWrong) {
  put("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
  refused({"poses.txt", "2 poses for 3 pictures of colour"});
  put("poses.txt", "1 0 0 0 0 1 0 0 0 0 2 0\n");
  refused({"poses.txt:1", "rigid"});
  put("poses.txt", "1 0 0 0 0 1 0 0 0 0 -1 0\n");  // a reflection
  refused({"poses.txt:1", "rigid"});
  put("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\n");
  refused({"poses.txt:1", "last row"});
  put("poses.txt", "1 0 0\n");
  refused({"poses.txt:1", "3 numbers"});
  put("poses.txt", "# none\n");
  refused({"0 poses for 3 pictures"});
  put("camera.txt", "width 2\nheight 2\nfx 2\n");
  refused({"camera.txt", "fy, cx, cy"});
  put("camera.txt", "width 2\nfocal 2\n");
  refused({"camera.txt:2", "'focal'"});
  put("camera.txt", "width 2\nwidth 3\n");
  refused({"camera.txt:2", "width"});
  put("camera.txt", "width 2.5\nheight 2\nfx 1\nfy 1\ncx 1\ncy 1\n");
  refused({"camera.txt", "width 2.5"});
  put("camera.txt", "width 2\nheight 2\nfx -1\nfy 1\ncx 1\ncy 1\n");
  refused({"camera.txt", "fx = -1"});
  fs::remove(root / "camera.txt");
  refused({"camera.txt", "no such file"});
}

TEST_F(FolderRecording, DepthNeedsAUnit) {
  put("camera.txt", "width 2\nheight 2\nfx 2\nfy 2\ncx 1\ncy 1\n");
  refused({"camera.txt", "depth_unit_m"});
  fs::remove_all(root / "depth");
  EXPECT_EQ(read_recording(root).size(), 3U);
  fs::remove_all(root / "colour");
  refused({"no pictures"});
}

TEST_F(FolderRecording, PicturesOfTheWrongKindAreRefusedWhenRead) {
  put("colour/2.ppm", "P3 1 1 255\n1 2 3\n");
  put("depth/9.pgm", "P2 2 2 255\n1 2 3 4\n");
  put("depth/10.pgm", "P2 2 2 65535\n1 2 3\n");
  const Recording r = read_recording(root);
  refuses([&] { return r.frame(0); }, {"2.ppm", "1 x 1 px", "2 x 2"});
  refuses([&] { return r.frame(1); }, {"9.pgm", "16-bit"});
  refuses([&] { return r.frame(2); }, {"10.pgm"});
}

// ---- depth without poses

// A corner and a ball, from views 8 mm and 1 degree apart; the left of each picture shows what stays with the camera.
class AlignedRecordingTest : public RecordingTest {
 protected:
  AlignedRecordingTest() {
    fs::create_directories(root / "depth");
    const auto corner = test::all_of(test::Plane{{0, 0, 1}, 0}, test::Plane{{1, 0, 0}, 0.5},
                                     test::Plane{{0, 1, 0}, 0.4}, test::Sphere{{0.32, 0.18, 0.08}, 0.08});
    for (int i = 0; i < 3; ++i) {
      truth.push_back(look_at({0.006 * i, -0.006 * i, 0.28}, {0.4, 0.28, 0.12}));
      Frame f = test::observe(corner, truth.back(), camera, Box3(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()));
      f.depth.leftCols(60).setConstant(3);
      write_png(root / "depth" / concat(i, ".png"), depth_to_steps(f.depth, 0.0001));
    }
    put_camera("depth_unit_m 0.0001\n");
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) first_pose += concat(truth[0].T_W_C(row, column), ' ');
    put("first_pose.txt", first_pose);
  }
  void put_camera(std::string_view more) const {
    put("camera.txt", concat("width 320\nheight 240\nfx ", camera.fx, "\nfy ", camera.fy, "\ncx 160\ncy 120\n", more));
  }
  void refused(std::initializer_list<std::string_view> named) const {
    refuses([&] { return read_aligned_recording(root, config); }, named);
  }
  const Camera camera = Camera::from_fov(320, 240, 1.1);
  const AlignedRecordingConfig config = {.range_m = 1};
  std::vector<View> truth;
  std::string first_pose;
};

TEST_F(AlignedRecordingTest, FindsThePoses) {
  ASSERT_TRUE(has_first_pose_only(root));
  const AlignedRecording found = read_aligned_recording(root, config);
  ASSERT_EQ(found.recording.size(), 3U);
  ASSERT_EQ(found.alignments.size(), 2U);
  EXPECT_EQ(found.recording.notes().size(), 1U);
  const std::vector<View> views = found.recording.views();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(distance_m(views[i], truth[i]), 0.002) << i;
    EXPECT_GT(views[i].forward().dot(truth[i].forward()), std::cos(deg(0.4))) << i;
  }
  EXPECT_TRUE(found.recording.frame(1).colour.empty());
  EXPECT_FLOAT_EQ(found.recording.frame(2).depth(100, 20), 3.0F) << "only the alignment looks no farther";
  put("poses.txt", "");
  EXPECT_FALSE(has_first_pose_only(root));
}

TEST_F(AlignedRecordingTest, NamesWhatIsWrong) {
  refuses([&] { return read_aligned_recording(root, {.range_m = 0}); }, {"range_m = 0"});
  write_png(root / "depth" / "1.png", Image<std::uint16_t>(Image<std::uint16_t>::Zero(240, 320)));
  refused({"(frame 1)", "does not align", "1 m"});
  put_camera("");
  refused({"camera.txt", "depth_unit_m"});
  put("first_pose.txt", first_pose + "\n" + first_pose);
  refused({"first_pose.txt", "2 poses"});
  put("first_pose.txt", first_pose);
  put_camera("depth_unit_m 0.0001\n");
  fs::remove_all(root / "depth");
  refused({"no frame"});
}

// ---- TUM RGB-D

class TumRecording : public RecordingTest {
 protected:
  TumRecording() {
    put("rgb.txt", "# color images\n100.00 rgb/a.ppm\n100.10 rgb/b.ppm\n100.20 rgb/c.ppm\n100.30 rgb/d e.ppm\n");
    put("depth.txt", "# depth maps\n100.105 depth/b.pgm\n100.008 depth/a.pgm\n100.31 depth/d.pgm\n");
    put("groundtruth.txt",
        "# timestamp tx ty tz qx qy qz qw\n99.995 1 2 3 0 0 0 1\n100.015 9 9 9 0 0 0 1\n"
        "100.098 4 5 6 0 0 0.7071 0.7071\n100.2 0 0 0 0 0 0 1\n100.31 7 8 9 0.5 -0.5 0.5 -0.5\n");
    for (const char* name : {"a", "b", "c", "d e"}) put(concat("rgb/", name, ".ppm"), colour(name[0] - 'a'));
    for (const char* name : {"a", "b", "d"}) put(concat("depth/", name, ".pgm"), depth(5000 * (name[0] - 'a' + 1)));
  }
};

TEST_F(TumRecording, PutsTogetherWhatIsNearestInTime) {
  const Recording r = read_recording(root);
  ASSERT_EQ(r.size(), 3U);  // c has no depth
  EXPECT_EQ(r.frames()[0].time_s, 100.0);
  EXPECT_EQ(r.views()[0].position(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(r.views()[1].position(), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(r.views()[2].position(), Eigen::Vector3d(7, 8, 9));
  EXPECT_TRUE(r.views()[1].T_W_C.linear().col(0).isApprox(Eigen::Vector3d(0, 1, 0), 1e-3));  // 90 degrees about z
  for (std::size_t i = 0; i < 3; ++i) check_view(r.views()[i], "view");
  EXPECT_FLOAT_EQ(r.frame(1).depth(0, 0), 2.0F);
  EXPECT_EQ(r.frame(2).colour.r(0, 0), 3.0F / 255);
  const Camera& c = r.frames()[0].camera;
  EXPECT_EQ(c.fx, 525);
  EXPECT_EQ(c.cx, 1);
  ASSERT_EQ(r.notes().size(), 2U);
  EXPECT_NE(r.notes()[0].find("525"), std::string::npos);
  EXPECT_NE(r.notes()[1].find("1 of 4"), std::string::npos);
}

TEST_F(TumRecording, CalibrationCountsFromThePixelsCentre) {
  put("calibration.txt", "517.3 516.5 0.5 0.25\n");
  const Recording r = read_recording(root);
  EXPECT_EQ(r.frames()[0].camera.fx, 517.3);
  EXPECT_EQ(r.frames()[0].camera.cx, 1.0);
  EXPECT_EQ(r.frames()[0].camera.cy, 0.75);
  put("calibration.txt", "517.3 516.5 0.5 0.25 0.1 0.2\n");
  refused({"calibration.txt:1", "distortion"});
  put("calibration.txt", "0 516.5 0.5 0.25\n");
  refused({"calibration.txt:1", "fx = 0"});
}

TEST_F(TumRecording, AcceptsAnotherCameraUnitAndReach) {
  const Camera camera{2, 2, 3, 3, 1, 1};
  const Recording r = read_tum_recording(root, {.camera = camera, .depth_per_m = 1000, .most_difference_s = 0.1});
  EXPECT_EQ(r.size(), 4U);
  EXPECT_TRUE(r.notes().empty());
  EXPECT_EQ(r.frames()[2].depth.filename(), "b.pgm");  // 0.095 s before, 0.11 s after
  EXPECT_FLOAT_EQ(r.frame(0).depth(0, 0), 5.0F);
  EXPECT_THROW(read_tum_recording(root, {.depth_per_m = 0}), Error);
}

TEST_F(TumRecording, NamesWhatIsWrong) {
  refuses([&] { return read_tum_recording(root, {.most_difference_s = 0.001}); }, {"0.001 s"});
  fs::remove(root / "depth" / "b.pgm");
  refused({"frame 1", "b.pgm"});
  put("groundtruth.txt", "100 1 2 3 0 0 0\n");
  refused({"groundtruth.txt:1", "7 words"});
  put("groundtruth.txt", "100 1 2 3 0 0 0 2\n");
  refused({"groundtruth.txt:1", "length 2"});
  put("groundtruth.txt", "100 1 x 3 0 0 0 1\n");
  refused({"groundtruth.txt:1", "'x'"});
  put("depth.txt", "100.0\n");
  refused({"depth.txt:1"});
  fs::remove(root / "depth.txt");
  refused({"depth.txt", "no such file"});
}

TEST_F(TumRecording, NothingListedIsNoRecording) {
  put("rgb.txt", "# nothing\n");
  refused({"rgb.txt", "no picture"});
}

TEST(NearestInTime, TheEarlierOfTwo) {
  const std::vector<Timed<int>> items = {{1, 1}, {2, 2}, {4, 4}};
  EXPECT_EQ(nearest_in_time(items, 0.5, 1)->value, 1);
  EXPECT_EQ(nearest_in_time(items, 1.5, 1)->value, 1);
  EXPECT_EQ(nearest_in_time(items, 3.1, 1)->value, 4);
  EXPECT_EQ(nearest_in_time(items, 5, 1)->value, 4);
  EXPECT_EQ(nearest_in_time(items, 5.1, 1), nullptr);
  EXPECT_EQ(nearest_in_time(std::vector<Timed<int>>{}, 1, 1), nullptr);
}

// ---- transforms.json

class TransformsRecording : public RecordingTest {
 protected:
  // A camera at (1, 2, 3) that looks along +x of the world, its image upright: in OpenGL's axes x = -y of the world,
  // y = z, z = -x.
  static constexpr std::string_view pose = "[[0,0,-1,1],[-1,0,0,2],[0,1,0,3],[0,0,0,1]]";
  void put_json(std::string_view intrinsics, std::string_view frame) const {
    put("transforms.json", concat("{", intrinsics, R"( "frames": [{)", frame, R"( "transform_matrix": )", pose, "}]}"));
  }
};

TEST_F(TransformsRecording, ReadsNerfstudio) {
  put("images/a.ppm", colour(7));
  put("depths/a.pgm", depth(2500));
  put_json(R"("camera_model": "OPENCV", "k1": 0.0, "fl_x": 3.5, "fl_y": 3, "cx": 1.25, "cy": 0.75, "w": 2, "h": 2,)",
           R"("file_path": "images/a.ppm", "depth_file_path": "depths/a.pgm",)");
  const Recording r = read_recording(root);
  ASSERT_EQ(r.size(), 1U);
  const Frame f = r.frame(0);
  EXPECT_EQ(f.camera.fx, 3.5);
  EXPECT_EQ(f.camera.fy, 3);
  EXPECT_EQ(f.camera.cx, 1.25);
  EXPECT_EQ(f.camera.cy, 0.75);
  EXPECT_FLOAT_EQ(f.depth(0, 0), 2.5F);
  EXPECT_EQ(f.view.position(), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(f.view.T_W_C.isApprox(look_at({1, 2, 3}, {2, 2, 3}).T_W_C));
}

TEST_F(TransformsRecording, ReadsNerfSyntheticWhoseSizeIsThePictures) {
  put("train/r_0.png", colour(7));  // told apart by its first bytes
  put("transforms_train.json",
      concat(R"({"camera_angle_x": 1.5707963267948966, "frames": [{"file_path": "./train/r_0", "rotation": 0.0126,)",
             R"("transform_matrix": )", pose, "}]}"));
  const Recording r = read_recording(root);
  const Camera& c = r.frames()[0].camera;
  EXPECT_EQ(c.width, 2);
  EXPECT_NEAR(c.fx, 1, 1e-12);
  EXPECT_EQ(c.fx, c.fy);
  EXPECT_EQ(c.cx, 1);
  EXPECT_EQ(r.frame(0).colour.r(0, 0), 7.0F / 255);
}

TEST_F(TransformsRecording, FramesMayHaveTheirOwnCamera) {
  put("a.ppm", colour(1));
  put("a.pgm", depth(10));
  put_json(R"("fl_x": 3, "w": 4, "h": 4, "integer_depth_scale": 0.5,)",
           R"("file_path": "a.ppm", "depth_path": "a.pgm", "fl_x": 5, "w": 2, "h": 2,)");
  const Frame f = read_recording(root / "transforms.json").frame(0);
  EXPECT_EQ(f.camera.fx, 5);
  EXPECT_EQ(f.camera.width, 2);
  EXPECT_FLOAT_EQ(f.depth(0, 0), 5.0F);
}

TEST_F(TransformsRecording, NamesWhatIsWrong) {
  put("a.ppm", colour(1));
  const std::string_view path = R"("file_path": "a.ppm",)";
  put_json(R"("fl_x": 3, "k1": 0.1,)", path);
  refused({"/k1", "distortion"});
  put_json(R"("fl_x": 3, "camera_model": "OPENCV_FISHEYE",)", path);
  refused({"camera_model", "OPENCV_FISHEYE"});
  put_json(R"("fl_x": -3,)", path);
  refused({"fl_x", "-3"});
  put_json(R"("fl_x": "3",)", path);
  refused({"fl_x"});
  put_json("", path);
  refused({"/frames/0", "focal length"});
  put_json(R"("fl_x": 3,)", "");
  refused({"/frames/0", "file_path"});
  put_json(R"("fl_x": 3,)", R"("file_path": "b.ppm",)");
  refused({"b.ppm"});
  put("transforms.json", R"({"fl_x": 3, "w": 2, "h": 2, "frames": []})");
  refused({"no frame"});
  put("transforms.json", R"({"fl_x": 3})");
  refused({"frames"});
  put("transforms.json",
      R"({"fl_x": 3, "frames": [{"file_path": "a.ppm", "transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]}]})");
  refused({"transform_matrix", "3 rows"});
  put("transforms.json",
      R"({"fl_x": 3, "frames": [{"file_path": "a.ppm", "transform_matrix": [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]}]})");
  refused({"frame 0", "rigid"});
  put("transforms.json", R"({"fl_x": 3, "frames": [{"file_path")");
  refused({"transforms.json:1", "ends at byte"});
}

// ---- COLMAP

class ColmapRecording : public RecordingTest {
 protected:
  ColmapRecording() {
    put("sparse/0/cameras.txt", "# Camera list\n1 PINHOLE 2 2 3.5 3 1 1.25\n7 SIMPLE_PINHOLE 2 2 4 1 1\n");
    // World to camera: the second turns by 90 degrees about z, its second line is blank.
    put("sparse/0/images.txt",
        "# Image list\n1 1 0 0 0 -1 -2 -3 7 b.ppm\n10.5 20.5 -1 11 12 4\n2 0.70710678 0 0 0.70710678 1 0 0 1 a.ppm\n\n"
        "3 1 0 0 0 0 0 0 1 sub/c.ppm\n\n");
    for (const char* name : {"a", "b", "sub/c"}) put(concat("images/", name, ".ppm"), colour(5));
  }
};

TEST_F(ColmapRecording, ReadsPinholeModels) {
  const Recording r = read_recording(root);
  ASSERT_EQ(r.size(), 3U);
  EXPECT_EQ(r.frames()[0].colour.filename(), "a.ppm");
  EXPECT_EQ(r.frames()[0].camera.fx, 3.5);
  EXPECT_EQ(r.frames()[0].camera.fy, 3);
  EXPECT_EQ(r.frames()[0].camera.cy, 1.25);
  EXPECT_EQ(r.frames()[1].camera.fx, 4);
  EXPECT_EQ(r.frames()[1].camera.fy, 4);
  EXPECT_EQ(r.frames()[1].camera.cy, 1);
  EXPECT_TRUE(r.views()[1].position().isApprox(Eigen::Vector3d(1, 2, 3)));
  // x_C = R x_W + t with R the turn that takes x to y, and t = x: the origin is at -R^T x = y.
  EXPECT_TRUE(r.views()[0].position().isApprox(Eigen::Vector3d(0, 1, 0), 1e-6));
  EXPECT_EQ(r.frame(2).colour.r(0, 0), 5.0F / 255);
  EXPECT_EQ(read_colmap_recording(root / "sparse" / "0", root / "images").size(), 3U);
}

TEST_F(ColmapRecording, NamesWhatIsWrong) {
  put("sparse/0/cameras.txt", "1 OPENCV 2 2 3 3 1 1 0 0 0 0\n");
  refused({"cameras.txt:1", "'OPENCV'", "image_undistorter"});
  put("sparse/0/cameras.txt", "1 PINHOLE 2 2 3 3 1\n");
  refused({"cameras.txt:1", "7 words"});
  put("sparse/0/cameras.txt", "1 PINHOLE 2 2 0 3 1 1\n");
  refused({"cameras.txt:1", "fx = 0"});
  put("sparse/0/cameras.txt", "1 PINHOLE 2 2 3 3 1 1\n1 PINHOLE 2 2 3 3 1 1\n");
  refused({"cameras.txt:2", "second camera 1"});
  put("sparse/0/cameras.txt", "1 PINHOLE 2 2 3 3 1 1\n");
  refused({"images.txt", "camera 7", "b.ppm"});
  put("sparse/0/images.txt", "1 1 0 0 0 0 0 0 1\n\n");
  refused({"images.txt:1", "9 words"});
  put("sparse/0/images.txt", "1 0 0 0 0 0 0 0 1 a.ppm\n\n");
  refused({"images.txt:1", "quaternion"});
  put("sparse/0/images.txt", "1 1 0 0 0 0 0 0 1 missing.ppm\n\n");
  refused({"missing.ppm"});
  put("sparse/0/images.txt", "");
  refused({"no frame"});
  fs::remove(root / "sparse/0/cameras.txt");
  fs::rename(root / "sparse/0/images.txt", root / "sparse/0/images.bin");
  put("sparse/0/cameras.bin", "");
  refused({"binary", "model_converter"});
}

// ---- Replica, and what is nothing

TEST_F(RecordingTest, ReadsReplica) {
  put("cam_params.json",
      R"({"camera": {"w": 2, "h": 2, "fx": 600.0, "fy": 600.0, "cx": 0.5, "cy": 0.5, "scale": 6553.5}})");
  put("room0/traj.txt", "1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1\n1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1\n");
  for (const char* i : {"0", "1"}) {
    put(concat("room0/results/frame00000", i, ".jpg"), colour(9));
    put(concat("room0/results/depth00000", i, ".png"), depth(13107));
  }
  const Recording r = read_recording(root / "room0");
  ASSERT_EQ(r.size(), 2U);
  EXPECT_EQ(r.frames()[0].camera.cx, 1.0);
  EXPECT_EQ(r.views()[1].position(), Eigen::Vector3d(4, 5, 6));
  EXPECT_FLOAT_EQ(r.frame(1).depth(0, 0), 2.0F);
}

TEST_F(RecordingTest, AReplicaCameraNamesWhatIsWrong) {
  const auto with = [](std::string_view w, std::string_view fx, std::string_view scale) {
    return parse_replica_camera(concat(R"({"camera": {"w": )", w, R"(, "h": 3, "fx": )", fx,
                                       R"(, "fy": 5, "cx": 1.5, "cy": 1, "scale": )", scale, "}}"),
                                "cam.json");
  };
  const auto [camera, depth_unit_m] = with("4", "6", "500");
  EXPECT_EQ(camera.width, 4);
  EXPECT_EQ(camera.height, 3);
  EXPECT_EQ(camera.fx, 6);
  EXPECT_EQ(camera.fy, 5);
  EXPECT_EQ(camera.cx, 2);
  EXPECT_EQ(camera.cy, 1.5);
  EXPECT_EQ(depth_unit_m, 0.002);
  refuses([&] { return with("4", "-6", "500"); }, {"cam.json", "fx = -6"});
  refuses([&] { return with("0", "6", "500"); }, {"cam.json", "width = 0"});
  refuses([&] { return with("4.5", "6", "500"); }, {"cam.json: /camera/w", "4.5"});
  refuses([&] { return with("4", "\"6\"", "500"); }, {"cam.json: /camera/fx", "string"});
  refuses([&] { return with("4", "6", "0"); }, {"cam.json: /camera/scale", "0"});
  refuses([] { return parse_replica_camera("{}", "cam.json"); }, {"cam.json", "'camera'"});
}

TEST_F(RecordingTest, SaysWhatARecordingIs) {
  refused({root.string(), "transforms.json", "poses.txt", "TUM", "COLMAP"});
  refuses([&] { return read_recording(root / "nothing"); }, {"nothing", "no such"});
  put("file.txt", "text");
  refuses([&] { return read_recording(root / "file.txt"); }, {"file.txt", "no recording"});
}

TEST_F(RecordingTest, NamesThatNoFileCanHaveAreErrorsLikeOthers) {
  const fs::path long_name = root / std::string(5000, 'x');
  refuses([&] { return read_recording(long_name); }, {"xxx: no such file or folder"});
  refuses([&] { return read_recording(long_name.string() + ".json"); }, {".json: no such file or folder"});
  refuses([&] { return read_recording(long_name / "below"); }, {"below: no such file or folder"});
  refuses([&] { return read_folder_recording(long_name); }, {"camera.txt"});
  refuses([&] { return read_tum_recording(long_name); }, {"rgb.txt"});
  refuses([&] { return read_replica_recording(long_name); }, {"cam_params.json"});
  refuses([&] { return read_colmap_recording(long_name, root); }, {"cameras.txt"});
  // Nor is a folder the file that tells a recording's kind.
  fs::create_directories(root / "poses.txt");
  refused({"no recording"});
}

TEST_F(RecordingTest, KnowsAJsonFileByItsNameInAnyCase) {
  put("A.JSON", "{}");
  refuses([&] { return read_recording(root / "A.JSON"); }, {"A.JSON", "frames"});
}

TEST_F(RecordingTest, ARecordingIsCheckedWhenMade) {
  put("a.ppm", colour(1));
  RecordedFrame frame;
  frame.camera = {2, 2, 1, 1, 1, 1};
  frame.colour = root / "a.ppm";
  EXPECT_EQ(Recording("test", {frame}).size(), 1U);
  refuses([&] { return Recording("test", {frame}, 0); }, {"test", "depth_unit_m"});
  refuses([&] { return Recording("test", {}); }, {"test", "no frame"});
  RecordedFrame bad = frame;
  bad.view.T_W_C.translation().x() = std::numeric_limits<double>::infinity();
  refuses([&] { return Recording("test", {frame, bad}); }, {"frame 1", "finite"});
  bad = frame;
  bad.colour.clear();
  refuses([&] { return Recording("test", {bad}); }, {"frame 0", "neither"});
  bad = frame;
  bad.camera.fx = 0;
  refuses([&] { return Recording("test", {frame, bad}); }, {"test (frame 1)", "fx = 0"});
}

}  // namespace
}  // namespace vantage
