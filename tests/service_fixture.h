// A service with a fake renderer, asked without sockets.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "fake_renderer.h"
#include "server/service/service.h"

namespace awan::test {

inline constexpr const char* kScene =
    R"({"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"seed":7,)"
    R"("image":{"width":16,"height":8},"accuracy":{"rung":"harris"}})";

using Headers = std::vector<std::pair<std::string, std::string>>;

inline Request make_request(std::string method, std::string path, std::string body = "",
                            Headers headers = {{"Content-Type", "application/json"}}) {
    Request request;
    request.method = std::move(method);
    request.path = std::move(path);
    request.body = std::move(body);
    request.headers = std::move(headers);
    request.id = "test-1";
    return request;
}

inline std::string whole_body(const Response& response) {
    std::string body(response.bytes());
    if (response.stream)
        while (response.stream(body)) {
        }
    return body;
}

class ServiceTest : public testing::Test {
  protected:
    explicit ServiceTest(ServiceOptions options = {})
        : thread(renderer.opener()), service(thread, metrics, with_fake(std::move(options))) {
        thread.wait_until_started();
    }
    ServiceOptions with_fake(ServiceOptions options) const {
        options.on_processor = renderer.on_processor();
        return options;
    }

    Response get(const std::string& path, Headers headers = {}) {
        return service.answer(make_request("GET", path, "", std::move(headers)));
    }
    Response post(const std::string& path, const std::string& body = kScene, Headers more = {},
                  const std::string& type = "application/json") {
        Headers headers = {{"Content-Type", type}};
        headers.insert(headers.end(), more.begin(), more.end());
        return service.answer(make_request("POST", path, body, headers));
    }

    FakeRenderer renderer;
    Metrics metrics;
    RenderThread thread;
    Service service;
};

inline void expect_problem(const Response& response, int status, const std::string& pointer = "") {
    EXPECT_EQ(response.status, status) << response.body;
    EXPECT_EQ(response.header("Content-Type"), "application/problem+json");
    EXPECT_NE(response.body.find("\"status\":" + std::to_string(status)), std::string::npos);
    EXPECT_NE(response.body.find("\"request_id\":\"test-1\""), std::string::npos);
    if (!pointer.empty()) {
        EXPECT_NE(response.body.find("\"pointer\":\"" + pointer + "\""), std::string::npos)
            << response.body;
    }
}

}  // namespace awan::test
