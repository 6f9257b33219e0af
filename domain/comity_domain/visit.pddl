; Visiting people, each in their own way: greeting them, telling and bringing them things, taking leave.
;
; For people and for tools that read PDDL: a test finds the same types, fluents, actions, preconditions and
; effects in the unified-planning problem (classical/visit_domain.py) that engines plan.
; Costs are whole centimetres of walking, or what is worth as much: a disliked option costs
; 100 * weight * -ln(desirability), with the weight in metres and the desirability in [0, 1].

(define (domain visit-domain)
  (:requirements :strips :typing :negative-preconditions :disjunctive-preconditions :conditional-effects
    :action-costs)

  (:types
    robot place side modality gesture company turn task thing - object
    user location - place)             ; people are places to be at: the robot stands on one of their sides

  (:predicates
    ; what changes
    (at ?r - robot ?p - place ?s - side)
    (docked ?r - robot ?p - place)     ; near enough to a person, and turned to them, to greet
    (free ?r - robot)                  ; owes nobody anything, so it may leave
    (holds ?r - robot ?h - thing)      ; in its hands; `nothing` is a thing, too
    (greeted ?u - user)
    (due ?t - task)                    ; comes next with its person
    (done ?t - task)
    (whole ?c - company)               ; nobody of it was greeted alone, so it can be greeted at once
    (waits ?u - user)                  ; somebody is to be visited before
    (skipped ?u - user)
    (now ?k - turn)                    ; how many were greeted, where somebody has a priority; else always the same

    ; what the person and the map allow
    (reachable ?u - user ?s - side)    ; the person accepts this side, and some route leads there
    (permitted ?u - user ?m - modality ?g - gesture)
    (route ?origin - place ?origin_side - side ?u - user ?s - side)
    (after ?u - user ?first - user)    ; the order that the scenario asks for
    (way_to ?origin - place ?origin_side - side ?l - location ?s - side)
    (dropped ?u - user)                ; no visit: decided before, by prices, routes, priorities and deadlines alone

    ; what hands are good for
    (empty ?h - thing)                 ; holding it is holding nothing
    (suits ?h - thing ?u - user)       ; who may be approached with it: anybody empty-handed, else whom it is for
    (leaves_open ?h - thing ?g - gesture)

    ; whose visit is under way: they were greeted before, and something on their agenda is left
    (begun ?u - user)

    ; what is to be done after the greeting, in its order
    (only_greeted ?u - user)           ; nothing
    (opens ?u - user ?t - task)
    (follows ?t - task ?next - task)
    (last ?t - task)
    (of ?t - task ?u - user)
    (message ?t - task)
    (pause ?t - task)
    (farewell ?t - task)
    (brings ?t - task ?h - thing)
    (first_brought ?t - task)          ; may be fetched before its person is reached
    (kept ?h - thing ?l - location)

    ; people who stand together, and are greeted and nothing else
    (member ?u - user ?c - company)
    (overlooks ?c - company ?u - user ?s - side)               ; all of them can be greeted from there
    (welcome ?c - company ?m - modality ?g - gesture)          ; each of them accepts this greeting

    ; the counting of people
    (lasts ?k - turn)                  ; no other turn follows: how many were greeted is no matter
    (then ?k - turn ?next - turn)
    (then_together ?c - company ?k - turn ?next - turn))

  (:functions
    ; one function per action, everything fused into it
    (travel_cost ?origin - place ?origin_side - side ?u - user ?s - side)    ; the route, and the dislike of the side
    (fetch_cost ?origin - place ?origin_side - side ?l - location)           ; the route
    ; the dislike of the greeting, and what it costs that others were greeted before
    (greet_cost ?u - user ?m - modality ?g - gesture ?k - turn)
    ; the same once for all of a company, and the dislike of how near the robot comes to its other members
    (greet_together_cost ?c - company ?u - user ?s - side ?m - modality ?g - gesture ?k - turn)
    (leave_cost ?u - user ?m - modality ?g - gesture)                    ; the dislike of the farewell
    (skip_cost ?u - user)                                                ; the price that the scenario names

    ; the parameters bound when the plan is made, rounded; the plan itself carries them with full precision
    (distance_mm ?u - user)
    (speed_mm_s ?u - user)
    (direction_mdeg ?u - user ?s - side)    ; without its sign: positive on the left, negative on the right
    (cap_ms ?t - task)                      ; of a pause

    (total-cost))

  ; Go to a person and dock at their conversational distance, from one of their sides. Where their visit is
  ; under way, it goes on with what is left.
  ; Binds the distance, the direction and the speed.
  (:action Reach_user
    :parameters (?r - robot ?u - user ?s - side ?origin - place ?origin_side - side ?h - thing)
    :precondition (and
      (free ?r)
      (at ?r ?origin ?origin_side)
      (holds ?r ?h)
      (suits ?h ?u)
      (or (not (greeted ?u)) (begun ?u))
      (not (waits ?u))
      (reachable ?u ?s)
      (route ?origin ?origin_side ?u ?s))
    :effect (and
      (at ?r ?u ?s)
      (docked ?r ?u)
      (not (at ?r ?origin ?origin_side))
      (not (docked ?r ?origin))
      (forall (?t - task) (when (and (begun ?u) (opens ?u ?t)) (due ?t)))
      (forall (?v - user) (when (after ?v ?u) (not (waits ?v))))
      (not (free ?r))                  ; whoever is approached is served to the end before the robot goes on
      (increase (total-cost) (travel_cost ?origin ?origin_side ?u ?s))))

  ; Greet the person the robot is docked to: in words, with a gesture, or both. Words alone take the gesture `none`.
  (:action Greet_person
    :parameters (?r - robot ?u - user ?m - modality ?g - gesture ?k - turn ?next - turn ?h - thing)
    :precondition (and
      (docked ?r ?u)
      (not (greeted ?u))
      (permitted ?u ?m ?g)
      (holds ?r ?h)
      (leaves_open ?h ?g)
      (now ?k)
      (then ?k ?next))
    :effect (and
      (greeted ?u)
      (when (not (lasts ?k)) (not (now ?k)))
      (now ?next)
      (when (only_greeted ?u) (free ?r))
      (forall (?t - task) (when (opens ?u ?t) (due ?t)))
      (forall (?c - company) (when (member ?u ?c) (not (whole ?c))))
      (increase (total-cost) (greet_cost ?u ?m ?g ?k))))

  ; Greet a whole company by one greeting, docked to one of its members where all of them see and hear the robot.
  (:action Greet_company
    :parameters (?r - robot ?c - company ?u - user ?s - side ?m - modality ?g - gesture ?k - turn ?next - turn)
    :precondition (and
      (docked ?r ?u)
      (at ?r ?u ?s)
      (whole ?c)
      (overlooks ?c ?u ?s)
      (welcome ?c ?m ?g)
      (now ?k)
      (then_together ?c ?k ?next))
    :effect (and
      (not (whole ?c))
      (free ?r)
      (when (not (lasts ?k)) (not (now ?k)))
      (now ?next)
      (forall (?v - user) (when (member ?v ?c) (greeted ?v)))
      (forall (?v - user ?w - user) (when (and (member ?w ?c) (after ?v ?w)) (not (waits ?v))))
      (increase (total-cost) (greet_together_cost ?c ?u ?s ?m ?g ?k))))

  ; Go where something is kept, and take it: before its person is reached, or once they wait for it.
  ; What was fetched is brought straight to whom it is for.
  (:action Fetch
    :parameters (?r - robot ?u - user ?t - task ?h - thing ?l - location ?s - side
                 ?origin - place ?origin_side - side ?e - thing)
    :precondition (and
      (of ?t ?u)
      (brings ?t ?h)
      (kept ?h ?l)
      (or (and (free ?r) (first_brought ?t) (or (not (greeted ?u)) (begun ?u))) (due ?t))
      (at ?r ?origin ?origin_side)
      (way_to ?origin ?origin_side ?l ?s)
      (holds ?r ?e)
      (empty ?e))
    :effect (and
      (at ?r ?l ?s)
      (holds ?r ?h)
      (not (at ?r ?origin ?origin_side))
      (not (docked ?r ?origin))
      (not (holds ?r ?e))
      (increase (total-cost) (fetch_cost ?origin ?origin_side ?l))))

  ; Come back to a person with what was fetched for them in the middle of their visit.
  (:action Return_to_user
    :parameters (?r - robot ?u - user ?s - side ?t - task ?h - thing ?origin - location ?origin_side - side)
    :precondition (and
      (of ?t ?u)
      (brings ?t ?h)
      (due ?t)
      (holds ?r ?h)
      (at ?r ?origin ?origin_side)
      (reachable ?u ?s)
      (route ?origin ?origin_side ?u ?s))
    :effect (and
      (at ?r ?u ?s)
      (docked ?r ?u)
      (not (at ?r ?origin ?origin_side))
      (increase (total-cost) (travel_cost ?origin ?origin_side ?u ?s))))

  ; Tell the person something. Binds the volume and the rate of speech.
  (:action Say
    :parameters (?r - robot ?u - user ?t - task)
    :precondition (and
      (of ?t ?u)
      (message ?t)
      (docked ?r ?u)
      (due ?t))
    :effect (and
      (done ?t)
      (not (due ?t))
      (forall (?n - task) (when (follows ?t ?n) (due ?n)))
      (when (last ?t) (free ?r))))

  ; Hand over what the robot holds.
  (:action Offer
    :parameters (?r - robot ?u - user ?t - task ?h - thing ?e - thing)
    :precondition (and
      (of ?t ?u)
      (brings ?t ?h)
      (docked ?r ?u)
      (due ?t)
      (holds ?r ?h)
      (empty ?e))
    :effect (and
      (done ?t)
      (not (due ?t))
      (not (holds ?r ?h))
      (holds ?r ?e)
      (forall (?n - task) (when (follows ?t ?n) (due ?n)))
      (when (last ?t) (free ?r))))

  ; Stay before the person for some time, or until they do something.
  (:action Wait
    :parameters (?r - robot ?u - user ?t - task)
    :precondition (and
      (of ?t ?u)
      (pause ?t)
      (docked ?r ?u)
      (due ?t))
    :effect (and
      (done ?t)
      (not (due ?t))
      (forall (?n - task) (when (follows ?t ?n) (due ?n)))
      (when (last ?t) (free ?r))))

  ; Say goodbye, in words, with a gesture, or both, and step away.
  (:action Take_leave
    :parameters (?r - robot ?u - user ?t - task ?m - modality ?g - gesture ?h - thing)
    :precondition (and
      (of ?t ?u)
      (farewell ?t)
      (docked ?r ?u)
      (due ?t)
      (permitted ?u ?m ?g)
      (holds ?r ?h)
      (leaves_open ?h ?g))
    :effect (and
      (done ?t)
      (not (due ?t))
      (free ?r)
      (increase (total-cost) (leave_cost ?u ?m ?g))))

  ; Drop a visit at its price.
  (:action Skip_visit
    :parameters (?r - robot ?u - user)
    :precondition (dropped ?u)
    :effect (and
      (skipped ?u)
      (increase (total-cost) (skip_cost ?u)))))
