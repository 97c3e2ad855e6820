//! The server of rosbridge: messages against the definitions of ROS 2, read by a client of the WebSocket.

use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use nalgebra::UnitQuaternion;
use palpate_devices::publisher::{Protocol, PublishedState, Publisher, ShownSurface, ShownTool};
use palpate_servo::{Fault, Vec3};
use serde_json::{Value, json};
use tungstenite::stream::MaybeTlsStream;
use tungstenite::{Message, WebSocket};

type Client = WebSocket<MaybeTlsStream<TcpStream>>;

const PLACE: Vec3 = Vec3::new(0.010, -0.020, 0.030);
const FORCE: Vec3 = Vec3::new(0.25, 0.5, -1.5);

fn server(fault: Option<Fault>) -> Publisher {
    let anywhere = SocketAddr::from((Ipv4Addr::LOCALHOST, 0));
    let server = Publisher::open(anywhere, Protocol::Rosbridge).unwrap();
    let tool = ShownTool {
        name: "the right".to_owned(),
        place: Some(PLACE),
        orientation: UnitQuaternion::from_axis_angle(&Vec3::z_axis(), std::f64::consts::FRAC_PI_2),
        force: FORCE,
        torque: Vec3::new(0.0, 0.125, 0.0),
        fault,
    };
    let surface = ShownSurface {
        vertices: vec![[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.25, 0.0]],
        triangles: vec![[0, 2, 1]],
    };
    server.show(
        move |picture: &mut PublishedState| picture.tools = vec![tool.clone()],
        move || surface.clone(),
    );
    server
}

fn connected(server: &Publisher) -> Client {
    let (client, _) = tungstenite::connect(format!("ws://{}/", server.address())).unwrap();
    let MaybeTlsStream::Plain(stream) = client.get_ref() else {
        unreachable!("it is on this machine")
    };
    stream
        .set_read_timeout(Some(Duration::from_secs(10)))
        .unwrap();
    client
}

fn send(client: &mut Client, message: &Value) {
    client.send(Message::text(message.to_string())).unwrap();
}

fn receive(client: &mut Client) -> Value {
    loop {
        if let Message::Text(text) = client.read().unwrap() {
            return serde_json::from_str(&text).unwrap();
        }
    }
}

/// The next message of a topic, subscribed to here.
fn message(server: &Publisher, topic: &str) -> Value {
    let mut client = connected(server);
    send(&mut client, &json!({"op": "subscribe", "topic": topic}));
    let found = receive(&mut client);
    assert_eq!(
        (&found["op"], &found["topic"]),
        (&json!("publish"), &json!(topic))
    );
    found["msg"].clone()
}

/// Judge: `geometry_msgs` and `shape_msgs` as ROS 2 defines them; the numbers by hand.
#[test]
fn messages_are_those_of_ros() {
    let server = server(None);
    assert!(server.address().ip().is_loopback());
    let pose = message(&server, "/palpate/the_right/pose");
    assert_eq!(pose["header"]["frame_id"], "scene");
    assert_eq!(
        pose["pose"]["position"],
        json!({"x": 0.010, "y": -0.020, "z": 0.030})
    );
    let half = std::f64::consts::FRAC_1_SQRT_2;
    for (name, expected) in [("x", 0.0), ("y", 0.0), ("z", half), ("w", half)] {
        let found = pose["pose"]["orientation"][name].as_f64().unwrap();
        assert!((found - expected).abs() < 1e-15, "{pose}");
    }
    let wrench = message(&server, "/palpate/the_right/wrench");
    assert_eq!(
        wrench["wrench"],
        json!({"force": {"x": 0.25, "y": 0.5, "z": -1.5}, "torque": {"x": 0.0, "y": 0.125, "z": 0.0}})
    );
    let seconds = wrench["header"]["stamp"]["sec"].as_u64().unwrap();
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    assert!(seconds.abs_diff(since.unwrap().as_secs()) <= 2);
    let mesh = message(&server, "/palpate/organ");
    assert_eq!(mesh["triangles"], json!([{"vertex_indices": [0, 2, 1]}]));
    assert_eq!(mesh["vertices"][1], json!({"x": 0.5, "y": 0.0, "z": 0.0}));
    assert_eq!(message(&server, "/palpate/status"), json!({"data": "ok"}));
}

#[test]
fn a_device_without_force_is_in_the_status() {
    let status = message(&server(Some(Fault::Silent)), "/palpate/status");
    let said = status["data"].as_str().unwrap();
    assert!(said.starts_with("the right: "), "{said}");
}

#[test]
fn topics_are_told_as_rosapi_tells_them() {
    let server = server(None);
    let mut client = connected(&server);
    let ask = json!({"op": "call_service", "service": "/rosapi/topics", "id": "7"});
    send(&mut client, &ask);
    let answer = receive(&mut client);
    assert_eq!(
        (&answer["id"], &answer["result"]),
        (&json!("7"), &json!(true))
    );
    assert_eq!(
        answer["values"]["topics"],
        json!([
            "/palpate/the_right/pose",
            "/palpate/the_right/wrench",
            "/palpate/organ",
            "/palpate/status"
        ])
    );
    assert_eq!(
        answer["values"]["types"][1],
        "geometry_msgs/msg/WrenchStamped"
    );
}

#[test]
fn what_is_no_question_gets_a_sentence() {
    let server = server(None);
    let mut client = connected(&server);
    let said = |client: &mut Client, text: &str| {
        client.send(Message::text(text)).unwrap();
        let answer = receive(client);
        assert_eq!(answer["op"], "status", "{answer}");
        answer["msg"].as_str().unwrap().to_owned()
    };
    assert!(said(&mut client, "{").contains("not JSON"));
    assert!(said(&mut client, "[1]").contains("without `op`"));
    let publish = json!({"op": "publish", "topic": "/palpate/the_right/pose", "msg": {}});
    assert!(said(&mut client, &publish.to_string()).contains("only publishes"));
    let nowhere = json!({"op": "subscribe", "topic": "/elsewhere"});
    assert!(said(&mut client, &nowhere.to_string()).contains("/palpate/organ"));
}

/// A throttled client gets a message a second, a free one fifty: twenty at least on a busy machine. A connection that is
/// silent keeps nobody waiting.
#[test]
#[ignore = "long"]
fn clients_get_topics_as_often_as_they_ask() {
    let server = server(None);
    let _silent = TcpStream::connect(server.address()).unwrap();
    let topic = "/palpate/the_right/wrench";
    let counted = |throttle: Value| {
        let mut client = connected(&server);
        let subscribe = json!({"op": "subscribe", "topic": topic, "throttle_rate": throttle});
        send(&mut client, &subscribe);
        let status = json!({"op": "subscribe", "topic": "/palpate/status"});
        send(&mut client, &status);
        let (mut count, begin) = (0, Instant::now());
        while begin.elapsed() < Duration::from_millis(1500) {
            count += u32::from(receive(&mut client)["topic"] == topic);
        }
        count
    };
    assert!((1..=2).contains(&counted(json!(1000))));
    assert!(counted(json!(0)) >= 20);
    // Nonsense is as nothing.
    assert!(counted(json!(-1e300)) >= 20);
}
