// A client of the protocol's own library: reads one message of each type, with its checksum, and prints it.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "igtlCapabilityMessage.h"
#include "igtlClientSocket.h"
#include "igtlPolyDataMessage.h"
#include "igtlSensorMessage.h"
#include "igtlStatusMessage.h"
#include "igtlTransformMessage.h"
#include "igtlUnit.h"

static igtl::ClientSocket::Pointer sock;

// The body of a message, or the end.
template <class M> typename M::Pointer body(igtl::MessageHeader::Pointer header) {
    typename M::Pointer message = M::New();
    message->SetMessageHeader(header);
    message->AllocatePack();
    bool timeout = false;
    sock->Receive(message->GetPackBodyPointer(), message->GetPackBodySize(), timeout);
    if (!(message->Unpack(1) & igtl::MessageHeader::UNPACK_BODY)) {
        fprintf(stderr, "%s: the checksum is wrong\n", header->GetDeviceType());
        exit(1);
    }
    return message;
}

static void ask(igtl::MessageBase *request) {
    request->SetDeviceName("");
    request->Pack();
    sock->Send(request->GetPackPointer(), request->GetPackSize());
}

int main(int count, char **arguments) {
    if (count < 2) return 2;
    sock = igtl::ClientSocket::New();
    if (sock->ConnectToServer("127.0.0.1", atoi(arguments[1])) != 0) return 1;
    sock->SetReceiveTimeout(5000);
    igtl::GetPolyDataMessage::Pointer surface = igtl::GetPolyDataMessage::New();
    ask(surface.GetPointer());
    // The library has no request for capabilities: a header alone.
    std::vector<char> header_alone(58, 0);
    header_alone[1] = 1;
    memcpy(&header_alone[2], "GET_CAPABIL", 11);
    sock->Send(header_alone.data(), header_alone.size());
    std::set<std::string> seen;
    for (int number = 0; number < 500 && seen.size() < 5; number++) {
        igtl::MessageHeader::Pointer header = igtl::MessageHeader::New();
        header->InitPack();
        bool timeout = false;
        if (sock->Receive(header->GetPackPointer(), header->GetPackSize(), timeout) != header->GetPackSize()) return 1;
        header->Unpack();
        std::string kind = header->GetDeviceType();
        const char *name = header->GetDeviceName();
        bool is_new = seen.insert(kind).second;
        if (kind == "TRANSFORM") {
            auto message = body<igtl::TransformMessage>(header);
            igtl::Matrix4x4 m;
            message->GetMatrix(m);
            if (!is_new) continue;
            printf("TRANSFORM %s:", name);
            for (int column = 0; column < 4; column++)
                for (int row = 0; row < 3; row++) printf(" %.3f", m[row][column] + 0.0f);
            printf("\n");
        } else if (kind == "SENSOR") {
            auto message = body<igtl::SensorMessage>(header);
            if (!is_new) continue;
            igtlUint64 unit = message->GetUnit();
            bool is_newton = (unit >> 54 & 0x3F) == igtl::Unit::SI_DERIVED_NEWTON && unit >> 60 == 0;
            printf("SENSOR %s: %d values, %s %d:", name, message->GetLength(), is_newton ? "newton" : "other",
                   (int)(unit >> 50 & 0xF));
            for (unsigned at = 0; at < message->GetLength(); at++) printf(" %.3f", message->GetValue(at));
            printf("\n");
        } else if (kind == "STATUS") {
            auto message = body<igtl::StatusMessage>(header);
            if (is_new)
                printf("STATUS %s: %d %d %s\n", name, message->GetCode(), (int)message->GetSubCode(),
                       message->GetStatusString());
        } else if (kind == "POLYDATA") {
            auto message = body<igtl::PolyDataMessage>(header);
            float point[3];
            message->GetPoints()->GetPoint(1, point);
            std::vector<igtlUint32> polygon(3);
            message->GetPolygons()->GetCell(0, polygon.data());
            printf("POLYDATA %s: %d points, %d polygons: %.3f %.3f %.3f: %u %u %u\n", name,
                   (int)message->GetPoints()->GetNumberOfPoints(), (int)message->GetPolygons()->GetNumberOfCells(),
                   point[0] + 0.0f, point[1] + 0.0f, point[2] + 0.0f, polygon[0], polygon[1], polygon[2]);
        } else if (kind == "CAPABILITY") {
            auto message = body<igtl::CapabilityMessage>(header);
            printf("CAPABILITY %s:", name);
            for (const std::string &type : message->GetTypes()) printf(" %s", type.c_str());
            printf("\n");
        } else {
            fprintf(stderr, "%s is not expected\n", kind.c_str());
            return 1;
        }
    }
    sock->CloseSocket();
    return seen.size() == 5 ? 0 : 1;
}
